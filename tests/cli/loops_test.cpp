// Boundary loops and connected parts on the command line: listed, fixed, and let slide.

#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kRound = 48;

/// Writes rings of triangles between circles about (x, 0), with misplaced inner corners, as an OFF file, which has no names.
void write_annuli(const std::string& path, const std::vector<double>& middles, double inner, double outer, int layers) {
  std::ofstream file(path);
  file.precision(17);
  const int each = kRound * (layers + 1), count = static_cast<int>(middles.size());
  file << "OFF\n" << each * count << ' ' << 2 * kRound * layers * count << " 0\n";
  for (const double middle : middles)
    for (int k = 0; k <= layers; ++k)
      for (int i = 0; i < kRound; ++i) {
        const bool inside = k > 0 && k < layers;
        const double r = inner + (outer - inner) * k / layers + (inside ? 0.3 * std::sin(7.0 * i + k) / layers : 0.0);
        const double t = 2 * std::numbers::pi * i / kRound;
        file << middle + r * std::cos(t) << ' ' << r * std::sin(t) << " 0\n";
      }
  for (int m = 0; m < count; ++m)
    for (int k = 0; k < layers; ++k)
      for (int i = 0; i < kRound; ++i) {
        const int a = m * each + k * kRound + i, b = m * each + k * kRound + (i + 1) % kRound;
        file << "3 " << a << ' ' << a + kRound << ' ' << b + kRound << "\n3 " << a << ' ' << b + kRound << ' ' << b << '\n';
      }
}

std::vector<std::array<double, 3>> vertices_of_off(const std::string& path) {
  std::ifstream file(path);
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0;
  file >> word >> vertices >> faces >> edges;
  std::vector<std::array<double, 3>> all(vertices);
  for (auto& p : all) file >> p[0] >> p[1] >> p[2];
  return all;
}

TEST(Loops, InfoListsThemWithTheirLengthsAndAreas) {
  const Folder folder;
  const std::string one = folder / "one.off", two = folder / "two.off";
  write_annuli(one, {0}, 1, 2, 3);
  write_annuli(two, {0, 10}, 1, 2, 3);
  const Output said = run({"info", one});
  EXPECT_THAT(said.out, HasSubstr("loop 1 (outer)"));
  EXPECT_THAT(said.out, Not(HasSubstr("part 1"))) << "one part is nothing to list";
  EXPECT_THAT(run({"info", two}).out, HasSubstr("part 2"));
  const auto outline = json_of(run({"info", two, "--json"}))["outline"];
  ASSERT_EQ(outline["boundary_loops"].size(), 4U);
  ASSERT_EQ(outline["parts"].size(), 2U);
  EXPECT_EQ(outline["left_out"], 0);
  const auto perimeter = [](double r) { return 2 * kRound * r * std::sin(std::numbers::pi / kRound); };
  const auto area = [](double r) { return kRound * r * r * std::sin(2 * std::numbers::pi / kRound) / 2; };
  for (std::size_t l = 0; l < 4; ++l) {
    const auto& loop = outline["boundary_loops"][l];
    const double radius = l % 2 == 0 ? 2 : 1;
    EXPECT_EQ(loop["part"], l / 2 + 1);
    EXPECT_EQ(loop["outer"], l % 2 == 0);
    EXPECT_EQ(loop["vertices"], kRound);
    EXPECT_NEAR(loop["length"], perimeter(radius), 1e-12);
    EXPECT_NEAR(loop["area"], area(radius), 1e-12);
  }
  for (const auto& part : outline["parts"]) {
    EXPECT_EQ(part["elements"], 6 * kRound);
    EXPECT_EQ(part["vertices"], 4 * kRound);
    EXPECT_NEAR(part["area"], area(2) - area(1), 1e-12);
  }
  const std::string solid = folder / "solid.vtk";
  ASSERT_EQ(run({"generate", "tetrahedra", "--size", "50", "-o", solid}).code, 0);
  EXPECT_TRUE(json_of(run({"info", solid, "--json"}))["outline"]["parts"].empty()) << "of volumes there are none";
}

TEST(Loops, OneSlidesAndTheOtherStays) {
  const Folder folder;
  const std::string in = folder / "in.off", out = folder / "out.off";
  write_annuli(in, {0}, 1, 2, 3);
  const auto held = smooth(in, out, {"--iterations", "5"});
  const auto slides = smooth(in, out, {"--iterations", "5", "--slide", "loop:1"});
  EXPECT_EQ(slides["sliding"], kRound);
  EXPECT_EQ(slides["free"], held["free"].get<int>() + kRound);
  const auto before = vertices_of_off(in), after = vertices_of_off(out);
  int moved = 0;
  for (int i = 0; i < kRound; ++i) {
    EXPECT_EQ(after[static_cast<std::size_t>(i)], before[static_cast<std::size_t>(i)]) << "of the hole";
    const auto outer = static_cast<std::size_t>(3 * kRound + i);
    moved += after[outer] != before[outer] ? 1 : 0;
    const double r = std::hypot(after[outer][0], after[outer][1]);
    EXPECT_LE(r, 2 + 1e-12);
    EXPECT_GE(r, 2 * std::cos(std::numbers::pi / kRound) - 1e-3 * std::sqrt(32.0)) << "along the circle's chords, within the bound";
  }
  EXPECT_GT(moved, 0);
  const auto fixed = smooth(in, out, {"--iterations", "5", "--boundary", "slide", "--fix", "loop:2"});
  EXPECT_EQ(fixed["after"]["minimum"], slides["after"]["minimum"]) << "the same said otherwise";
}

TEST(Loops, OfOnePartOnlyThatMoves) {
  const Folder folder;
  const std::string in = folder / "in.off", out = folder / "out.off";
  write_annuli(in, {0, 10}, 1, 2, 3);
  (void)smooth(in, out, {"--iterations", "3", "--fix", "part:1"});
  const auto before = vertices_of_off(in), after = vertices_of_off(out);
  const auto half = static_cast<std::ptrdiff_t>(before.size() / 2);
  EXPECT_TRUE(std::equal(before.begin(), before.begin() + half, after.begin()));
  EXPECT_FALSE(std::equal(before.begin() + half, before.end(), after.begin() + half));
}

TEST(Loops, WhatDoesNotExistIsRefused) {
  const Folder folder;
  const std::string in = folder / "in.off", out = folder / "out.off";
  write_annuli(in, {0}, 1, 2, 3);
  const Output no_loop = run({"smooth", in, "-o", out, "--slide", "loop:3"});
  EXPECT_EQ(no_loop.code, 2);
  EXPECT_THAT(no_loop.err, HasSubstr("--slide loop:3: the mesh has 2 boundary loops, loop:1 to loop:2"));
  const Output inside = run({"smooth", in, "-o", out, "--slide", std::to_string(kRound + 1)});
  EXPECT_EQ(inside.code, 2);
  EXPECT_THAT(inside.err, HasSubstr("--slide none of these vertices is on the boundary"));
}

TEST(Loops, TheSessionSaysItAlike) {
  const Folder folder;
  const std::string in = folder / "in.off", by_script = folder / "script.off", by_option = folder / "option.off";
  write_annuli(in, {0}, 1, 2, 3);
  const std::string script = folder / "s.txt";
  std::ofstream(script) << "open " << in << "\nslide loop:1\nrun 4\nexport " << by_script << "\n";
  const Output said = run({"script", script});
  ASSERT_EQ(said.code, 0) << said.err;
  (void)smooth(in, by_option, {"--iterations", "4", "--slide", "loop:1", "--write", "last"});
  EXPECT_EQ(vertices_of_off(by_script), vertices_of_off(by_option));
}

}  // namespace
}  // namespace dmoscope::test
