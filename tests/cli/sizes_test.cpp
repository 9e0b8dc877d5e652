// Meshes so small or so large that squares, cubes and products of edges leave the range of doubles: the same figures as at size 1, or a
// refusal that names the file and the possible sizes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// 4 x 4 squares in triangles, jittered inside, or 3 x 3 x 3 cubes; all coordinates are whole multiples of 2^exponent.
std::string planar_mesh(int exponent) {
  std::string text = "OFF\n25 32 0\n";
  for (int v = 0; v < 25; ++v) {
    const int x = v % 5, y = v / 5;
    const bool inside = x > 0 && x < 4 && y > 0 && y < 4;
    text += fmt::format("{} {} 0\n", std::ldexp(8 * x + (inside ? v * 5 % 7 - 3 : 0), exponent),
                        std::ldexp(8 * y + (inside ? v * 3 % 5 - 2 : 0), exponent));
  }
  for (int e = 0; e < 16; ++e) {
    const int a = e / 4 * 5 + e % 4;
    text += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, a + 1, a + 6, a, a + 6, a + 5);
  }
  return text;
}
std::string volume_mesh(int exponent) {
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices 64\n";
  for (int v = 0; v < 64; ++v) {
    const std::array<int, 3> at{v % 4, v / 4 % 4, v / 16};
    const bool inside = std::ranges::all_of(at, [](int i) { return i == 1 || i == 2; });
    for (int axis = 0; axis < 3; ++axis)
      text += fmt::format("{} ", std::ldexp(8 * at[static_cast<std::size_t>(axis)] + (inside ? v * (5 + axis) % 5 - 2 : 0), exponent));
    text += "0\n";
  }
  text += "Hexahedra 27\n";
  for (int e = 0; e < 27; ++e) {
    for (const int step : {0, 1, 5, 4, 16, 17, 21, 20}) text += fmt::format("{} ", e % 3 + e / 3 % 3 * 4 + e / 9 * 16 + step + 1);
    text += "0\n";
  }
  return text + "End\n";
}

/// All numbers but those in comments.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; words >> word;)
      if (char* end = nullptr; (void)std::strtod(word.c_str(), &end), *end == '\0') numbers.push_back(std::strtod(word.c_str(), nullptr));
  }
  return numbers;
}

struct Kind {
  std::string name;
  std::string (*bytes)(int exponent);
  std::array<int, 3> fine;     // exponents with results: the limits, and one between
  std::array<int, 2> refused;  // exponents beyond either limit
};
// Lengths of 45 (or 42) units: planar meshes from 1e-75 on and, to be smoothed, up to 1e74, volumes from 1e-36 to 1e35.
const std::array<Kind, 2> kKinds{Kind{"a.off", planar_mesh, {-254, -120, 240}, {-255, 241}},
                                 Kind{"a.mesh", volume_mesh, {-124, -60, 110}, {-125, 111}}};

TEST(Sizes, FiguresDoNotDependOnThem) {
  const Folder folder;
  for (const Kind& kind : kKinds) {
    const std::string unit = folder.file("unit_" + kind.name, kind.bytes(0)), out = folder / ("out_" + kind.name);
    const auto judged = json_of(run({"quality", unit, "--metric", "all", "--json"}))["metrics"];
    for (const int exponent : kind.fine) {
      SCOPED_TRACE(::testing::Message() << kind.name << " times 2^" << exponent);
      const std::string in = folder.file(kind.name, kind.bytes(exponent));
      EXPECT_EQ(json_of(run({"quality", in, "--metric", "all", "--json"}))["metrics"], judged);
      for (const char* method : {"dmo", "laplace", "dvr", "active-set", "pattern-search"}) {
        const std::vector<std::string> more{"--method", method, "--iterations", "5"};
        const auto after = smooth(in, out, more), expected = smooth(unit, folder / ("unit_out_" + kind.name), more);
        EXPECT_EQ(after["after"], expected["after"]) << method;
        EXPECT_GT(after["after"]["minimum"].get<double>(), after["before"]["minimum"].get<double>()) << method;
      }
      EXPECT_EQ(run({"quality", out}).code, 0) << "what was written can be read again";
    }
  }
}

TEST(Sizes, BeyondThemFileAndSizeAreNamed) {
  const Folder folder;
  for (const Kind& kind : kKinds) {
    for (const int exponent : {kind.refused[0], kind.refused[1], -1000, 1000, 1018}) {
      SCOPED_TRACE(::testing::Message() << kind.name << " times 2^" << exponent);
      const std::string in = folder.file(kind.name, kind.bytes(exponent)), out = folder / ("out_" + kind.name);
      std::vector<std::vector<std::string>> calls{{"smooth", in, "-o", out, "--iterations", "1"},
                                                  {"compare", in, "--run", "dmo", "--iterations", "1"}};
      const bool also_judged = exponent == kind.refused[1];  // smoothed meshes have room to grow
      if (!also_judged) calls.insert(calls.end(), {{"quality", in}, {"info", in}, {"convert", in, out}});
      for (const auto& call : calls) {
        const Output output = run(call);
        EXPECT_EQ(output.code, 3) << call[0];
        EXPECT_THAT(output.err, AllOf(HasSubstr(in), HasSubstr("units large; sizes from 1e-"))) << call[0];
        EXPECT_THAT(output.err, ::testing::Not(HasSubstr("inf"))) << call[0];
      }
      EXPECT_FALSE(exists(out));
      if (!also_judged) continue;
      EXPECT_EQ(run({"quality", in}).code, 0);
      ASSERT_EQ(run({"convert", in, folder / "other.vtk"}).code, 0);
      ASSERT_EQ(run({"convert", folder / "other.vtk", out}).code, 0);
      EXPECT_EQ(numbers_in(read_file(out)), numbers_in(kind.bytes(exponent)));
      std::filesystem::remove(out);
    }
  }
}

}  // namespace
}  // namespace dmoscope::test
