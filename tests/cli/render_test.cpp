// Pictures by the command line: the visible part of a mesh.

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

TEST(Render, LooksInsideAVolume) {
  const std::string mesh = shared_mesh("tet/tire.vtk");
  if (mesh.empty()) GTEST_SKIP() << "the shared meshes are not here";
  const Folder folder;
  const std::vector<std::vector<std::string>> looks{{},
                                                    {"--clip", "x", "--clip-mode", "cut"},
                                                    {"--clip", "0,1,1:0"},
                                                    {"--peel", "2"},
                                                    {"--peel-quality", "0.5", "--perspective"},
                                                    {"--worst", "50", "--view", "+z"},
                                                    {"--isolate", "0:0.4", "--shrink", "0.8"}};
  std::set<std::string> pictures;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const std::string picture = folder / (std::to_string(i) + ".png");
    std::vector<std::string> arguments{"render", mesh, "-o", picture, "--size", "160x120"};
    arguments.insert(arguments.end(), looks[i].begin(), looks[i].end());
    const Output output = run(arguments);
    if (cannot_draw(output)) GTEST_SKIP() << output.err;
    ASSERT_EQ(output.code, 0) << output.err;
    pictures.insert(read_file(picture));
  }
  EXPECT_EQ(pictures.size(), looks.size()) << "each look differs";
}

/// A roof whose square below lies in y stands upright as in the window.
TEST(Render, GuessesTheUpAxisAsTheWindowDoes) {
  const Folder folder;
  const std::string roof = folder / "roof.off";
  std::ofstream(roof) << "OFF\n5 5 0\n-1 0 -1\n1 0 -1\n1 0 1\n-1 0 1\n0 1 0\n4 0 1 2 3\n3 1 0 4\n3 2 1 4\n3 3 2 4\n3 0 3 4\n";
  std::map<std::string, std::string> pictures;
  for (const std::string up : {"auto", "y", "z"}) {
    const std::string picture = folder / (up + ".png");
    const Output output = run({"render", roof, "-o", picture, "--size", "160x120", "--up", up});
    if (cannot_draw(output)) GTEST_SKIP() << output.err;
    ASSERT_EQ(output.code, 0) << output.err;
    pictures[up] = read_file(picture);
  }
  EXPECT_EQ(pictures["auto"], pictures["y"]);
  EXPECT_NE(pictures["auto"], pictures["z"]);
  EXPECT_NE(run({"render", roof, "-o", folder / "x.png", "--up", "x"}).code, 0);
}

TEST(Render, ShowsAPartLargerInThePlaneAndInSpace) {
  const Folder folder;
  const std::string flat = folder / "flat.off", solid = folder / "solid.vtk";
  ASSERT_EQ(run({"generate", "grid", "--size", "100", "-o", flat}).code, 0);
  ASSERT_EQ(run({"generate", "screw", "--size", "300", "-o", solid}).code, 0);
  for (const std::string& mesh : {flat, solid}) {
    SCOPED_TRACE(mesh);
    std::set<std::string> pictures;
    std::string plain, once;
    for (const std::vector<std::string>& look : std::vector<std::vector<std::string>>{
             {}, {"--zoom", "1"}, {"--zoom", "2"}, {"--zoom", "0.5"}, {"--at", "0.1,0.2"}, {"--zoom", "3", "--at", "0.1,0.2,0.3"}}) {
      const std::string picture = folder / "out.png";
      std::vector<std::string> arguments{"render", mesh, "-o", picture, "--size", "160x120"};
      arguments.insert(arguments.end(), look.begin(), look.end());
      const Output output = run(arguments);
      if (cannot_draw(output)) GTEST_SKIP() << output.err;
      ASSERT_EQ(output.code, 0) << output.err;
      pictures.insert(read_file(picture));
      if (look.empty()) plain = read_file(picture);
      if (look == std::vector<std::string>{"--zoom", "1"}) once = read_file(picture);
    }
    EXPECT_EQ(plain, once);
    EXPECT_EQ(pictures.size(), 5U) << "each of the others differs";
  }
}

TEST(Render, TakesEveryWordOfTheWindowsRanges) {
  const Folder folder;
  const std::string mesh = folder / "globe.14";  // its least quality is far above 0
  ASSERT_EQ(run({"generate", "globe", "-o", mesh}).code, 0);
  std::map<std::string, std::string> pictures;
  for (const std::string range : {"", "input", "fixed", "auto", "expanding", "percentile", "percentile:2:98", "percentile:20:60", "0:1"}) {
    const std::string picture = folder / "out.png";
    std::vector<std::string> arguments{"render", mesh, "-o", picture, "--size", "160x120"};
    if (!range.empty()) arguments.insert(arguments.end(), {"--range", range});
    const Output output = run(arguments);
    if (cannot_draw(output)) GTEST_SKIP() << output.err;
    ASSERT_EQ(output.code, 0) << range << output.err;
    pictures[range] = read_file(picture);
  }
  EXPECT_EQ(pictures["input"], pictures[""]) << "colours start from the mesh";
  EXPECT_NE(pictures["input"], pictures["fixed"]);
  EXPECT_EQ(pictures["0:1"], pictures["fixed"]);
  EXPECT_EQ(pictures["expanding"], pictures["auto"]) << "of one mesh";
  EXPECT_NE(pictures["auto"], pictures["fixed"]);
  EXPECT_EQ(pictures["percentile:2:98"], pictures["percentile"]);
  EXPECT_NE(pictures["percentile:20:60"], pictures["percentile"]);
}

}  // namespace
}  // namespace dmoscope::test
