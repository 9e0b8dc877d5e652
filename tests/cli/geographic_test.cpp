// Meshes in degrees are judged and smoothed on the Earth.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Sea {
  std::vector<std::array<double, 3>> nodes;  // x, y, depth
  std::vector<std::array<std::size_t, 3>> triangles;
};

/// The mean ratio of the worst triangle, each one flattened with the cosine of the latitude at its middle.
double least_on_earth(const Sea& sea) {
  double least = 1.0;
  for (const auto& t : sea.triangles) {
    const double middle = (sea.nodes[t[0]][1] + sea.nodes[t[1]][1] + sea.nodes[t[2]][1]) / 3.0;
    const double c = std::cos(middle * std::numbers::pi / 180.0);
    const auto way = [&](std::size_t a, std::size_t b) {
      return std::array{c * (sea.nodes[t[b]][0] - sea.nodes[t[a]][0]), sea.nodes[t[b]][1] - sea.nodes[t[a]][1]};
    };
    const auto ab = way(0, 1), bc = way(1, 2), ca = way(2, 0);
    const auto square = [](const std::array<double, 2>& w) { return w[0] * w[0] + w[1] * w[1]; };
    const double area = 0.5 * (ab[0] * bc[1] - ab[1] * bc[0]);
    least = std::min(least, 4.0 * std::sqrt(3.0) * area / (square(ab) + square(bc) + square(ca)));
  }
  return least;
}

/// Rows of triangles that are nearly equilateral on the Earth, from 55 to 66 degrees north, 0.1 degrees high, inner nodes out of place.
Sea northern_sea() {
  constexpr std::size_t kAcross = 8, kRows = 110;
  constexpr double kHigh = 0.1;
  Sea sea;
  for (std::size_t j = 0; j <= kRows; ++j)
    for (std::size_t i = 0; i <= kAcross; ++i) {
      const double y = 55.0 + kHigh * static_cast<double>(j);
      const double wide = kHigh * 2.0 / std::sqrt(3.0) / std::cos(60.5 * std::numbers::pi / 180.0);
      const bool inside = i > 0 && j > 0 && i < kAcross && j < kRows;
      const double turn = 1.9 * static_cast<double>(i) + 2.7 * static_cast<double>(j);
      const double x = -20.0 + wide * (static_cast<double>(i) + (j % 2 == 1 ? 0.5 : 0.0));
      sea.nodes.push_back({x + (inside ? 0.25 * wide * std::cos(turn) : 0.0), y + (inside ? 0.25 * kHigh * std::sin(turn) : 0.0), 0.0});
      sea.nodes.back()[2] = 100.0 + 3.0 * sea.nodes.back()[0] - 2.0 * sea.nodes.back()[1];
    }
  for (std::size_t j = 0; j < kRows; ++j)
    for (std::size_t i = 0; i < kAcross; ++i) {
      const std::size_t a = j * (kAcross + 1) + i, b = a + 1, d = a + kAcross + 1, c = d + 1;
      if (j % 2 == 0) {
        sea.triangles.push_back({a, b, d});
        sea.triangles.push_back({b, c, d});
      } else {
        sea.triangles.push_back({a, b, c});
        sea.triangles.push_back({a, c, d});
      }
    }
  return sea;
}

std::string text_of(const Sea& sea, const std::string& title) {
  std::string text = fmt::format("{}\n{} {}\n", title, sea.triangles.size(), sea.nodes.size());
  for (std::size_t v = 0; v < sea.nodes.size(); ++v)
    text += fmt::format("{} {:.10f} {:.10f} {:.8f}\n", v + 1, sea.nodes[v][0], sea.nodes[v][1], sea.nodes[v][2]);
  for (std::size_t t = 0; t < sea.triangles.size(); ++t)
    text += fmt::format("{} 3 {} {} {}\n", t + 1, sea.triangles[t][0] + 1, sea.triangles[t][1] + 1, sea.triangles[t][2] + 1);
  return text;
}

Sea with_nodes_of(Sea sea, const std::string& file) {
  const auto lines = lines_of(read_file(file));
  for (std::size_t v = 0; v < sea.nodes.size(); ++v) {
    std::istringstream line(lines.at(v + 2));
    int number = 0;
    line >> number >> sea.nodes[v][0] >> sea.nodes[v][1] >> sea.nodes[v][2];
  }
  return sea;
}

TEST(GeographicOnTheCommandLine, IsJudgedAndSmoothedOnTheEarth) {
  const Folder folder;
  const Sea sea = northern_sea();
  const std::string in = folder.file("sea.14", text_of(sea, "a northern sea, in degrees")), out = folder / "out.14";
  const double before = least_on_earth(sea);
  EXPECT_NEAR(json_of(run({"quality", in, "--json", "--metric", "mean-ratio"}))["metrics"][0]["minimum"].get<double>(), before, 1e-3);
  const auto json = smooth(in, out, {"--iterations", "20"});
  EXPECT_EQ(json["geographic"], true);
  EXPECT_NEAR(json["before"]["minimum"].get<double>(), before, 1e-3);
  const Sea moved = with_nodes_of(sea, out);
  EXPECT_NEAR(json["after"]["minimum"].get<double>(), least_on_earth(moved), 1e-3);
  EXPECT_GT(least_on_earth(moved), before + 0.1);
  // Without the projection the triangles are stretched to about half their width.
  const auto flat = smooth(in, folder / "flat.14", {"--iterations", "20", "--geographic", "off"});
  EXPECT_LT(flat["before"]["minimum"].get<double>(), before - 0.1);
  EXPECT_EQ(flat["geographic"], false);
  // The depth is linear in degrees, and unmoved vertices keep their lines.
  const auto lines = lines_of(read_file(in)), after = lines_of(read_file(out));
  for (std::size_t v = 0; v < sea.nodes.size(); ++v) {
    EXPECT_NEAR(moved.nodes[v][2], 100.0 + 3.0 * moved.nodes[v][0] - 2.0 * moved.nodes[v][1], 1e-6);
    if (v <= 8) {
      EXPECT_EQ(after[v + 2], lines[v + 2]);
    }
  }
}

TEST(GeographicOnTheCommandLine, ItIsSaidAndWhereInDoubtAsked) {
  const Folder folder;
  const Sea sea = northern_sea();
  const std::string said = folder.file("said.14", text_of(sea, "longitude and latitude")),
                    doubt = folder.file("doubt.14", text_of(sea, "a sea"));
  const std::string square = folder.file("square.14", "a unit square\n2 4\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n1 3 1 2 3\n2 3 1 3 4\n");
  EXPECT_THAT(run({"smooth", said, "-o", folder / "a.14"}).out, HasSubstr("judged on the Earth"));
  EXPECT_THAT(run({"quality", said}).err, HasSubstr("judged on the Earth (--geographic off"));
  EXPECT_THAT(run({"quality", doubt}).err, HasSubstr("--geographic on judges it on the Earth"));
  EXPECT_THAT(run({"quality", square}).err, Not(HasSubstr("geographic")));
  EXPECT_THAT(run({"quality", doubt, "--geographic", "off"}).err, Not(HasSubstr("geographic")));
  const auto least = [](const std::vector<std::string>& words) { return json_of(run(words))["metrics"][0]["minimum"].get<double>(); };
  const double earth = least({"quality", said, "--json", "--metric", "mean-ratio"});
  EXPECT_EQ(least({"quality", doubt, "--json", "--metric", "mean-ratio", "--geographic", "on"}), earth);
  EXPECT_EQ(least({"quality", doubt, "--json", "--metric", "mean-ratio"}),
            least({"quality", said, "--json", "--metric", "mean-ratio", "--geographic", "off"}));
  EXPECT_EQ(run({"quality", said, "--geographic", "maybe"}).code, 2);
  ASSERT_EQ(run({"generate", "hexahedra", "--size", "200", "-o", folder / "cube.vtk"}).code, 0);
  const Output solid = run({"quality", folder / "cube.vtk", "--geographic", "on"});
  EXPECT_EQ(solid.code, 3);
  EXPECT_THAT(solid.err, HasSubstr("it has volume elements"));
}

/// In the plane of its numbers the element round a pole is inverted, and untangling it sends vertices beyond latitude 90.
TEST(GeographicOnTheCommandLine, AGlobeWithItsPoleIsRefusedNotWrecked) {
  constexpr int kRound = 12, kRows = 3;
  constexpr std::array<double, kRows> kLatitudes{60.0, 80.0, 89.8};
  std::string text = fmt::format("ocean\n{} {}\n", 2 * kRound * (kRows - 1) + kRound - 2, kRound * kRows);
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kRound; ++i)
      text +=
          fmt::format("{} {} {} 1\n", row * kRound + i + 1, -179.5 + 359.0 * i / (kRound - 1), kLatitudes[static_cast<std::size_t>(row)]);
  int element = 0;
  const auto add = [&](int a, int b, int c) { text += fmt::format("{} 3 {} {} {}\n", ++element, a + 1, b + 1, c + 1); };
  for (int row = 0; row + 1 < kRows; ++row)
    for (int i = 0; i < kRound; ++i) {
      const int a = row * kRound + i, b = row * kRound + (i + 1) % kRound;
      add(a, b, b + kRound);
      add(a, b + kRound, a + kRound);
    }
  for (int i = 1; i + 1 < kRound; ++i) add(2 * kRound, 2 * kRound + i, 2 * kRound + i + 1);
  const Folder folder;
  const std::string globe = folder.file("globe.14", text + "0\n0\n0\n0\n");
  const Output refused = run({"smooth", globe, "-o", folder / "out.14"});
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("up to a pole"), HasSubstr("--geographic off")));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.14"));
  EXPECT_THAT(run({"quality", globe}).err, HasSubstr("in the plane of its numbers"));
}

/// Words with places use the file's coordinates, and a session that is saved comes back the same.
TEST(GeographicOnTheCommandLine, PlacesAreTheFilesAndSessionsComeBack) {
  const Folder folder;
  const Sea sea = northern_sea();
  const std::string in = folder.file("sea.14", text_of(sea, "in degrees"));
  smooth(in, folder / "fixed.14", {"--iterations", "2", "--fix", "box:-30,50,30,60"});
  const Sea moved = with_nodes_of(sea, folder / "fixed.14");
  std::size_t north = 0;
  for (std::size_t v = 0; v < sea.nodes.size(); ++v) {
    const bool same = std::abs(moved.nodes[v][0] - sea.nodes[v][0]) < 1e-9 && std::abs(moved.nodes[v][1] - sea.nodes[v][1]) < 1e-9;
    if (sea.nodes[v][1] <= 60.0) {
      EXPECT_TRUE(same) << v;
    }
    north += same ? 0 : 1;
  }
  EXPECT_GT(north, 100U);
  const auto worst =
      json_of(run({"quality", in, "--json", "--metric", "mean-ratio", "--worst", "1"}))["metrics"][0]["worst"][0]["centroid"];
  EXPECT_GT(worst[1].get<double>(), 54.9);
  EXPECT_LT(worst[1].get<double>(), 66.1);

  const std::string one = folder.file(
      "one.txt", "open " + in + "\nstep iteration 3\nsave-state " + (folder / "s.json") + "\nexport " + (folder / "a.14") + "\n");
  const std::string two =
      folder.file("two.txt", "open-state " + (folder / "s.json") + "\nexport " + (folder / "b.14") + "\ngeographic off\nopen " + in +
                                 "\nstep iteration 3\nexport " + (folder / "c.14") + "\n");
  ASSERT_EQ(run({"script", one}).code, 0);
  const Output again = run({"script", two});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read_file(folder / "a.14"), read_file(folder / "b.14"));
  EXPECT_NE(read_file(folder / "a.14"), read_file(folder / "c.14"));
}

}  // namespace
}  // namespace dmoscope::test
