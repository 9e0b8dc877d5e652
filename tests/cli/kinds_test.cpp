// --corner, --feature and their opposites on the command line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class KindsOnTheCommandLine : public ::testing::Test {
 protected:
  /// Makes a mesh of about 64 hexahedra; the number of a vertex counts x first.
  KindsOnTheCommandLine() { EXPECT_EQ(run({"generate", "hexahedra", "--size", "125", "-o", in_}).code, 0); }
  [[nodiscard]] Output smoothed(std::vector<std::string> more) const {
    std::vector<std::string> words{"smooth", in_, "-o", folder_ / "b.vtk", "--iterations", "3", "--boundary", "slide"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  const Folder folder_;
  const std::string in_ = folder_ / "a.vtk";
};

TEST_F(KindsOnTheCommandLine, AreCountedAndDone) {
  const auto plain = json_of(smoothed({"--json"}));
  ASSERT_EQ(plain["vertices"], 125);
  const auto said = json_of(smoothed({"--corner", "12", "--corner", "2-3", "--no-feature", "chain:20-21", "--feature", "6-7-8", "--json"}));
  const auto& kinds = said["parameters"]["kinds_by_user"];
  EXPECT_EQ(kinds["corners"], 3);
  EXPECT_EQ(kinds["no_corners"], 0);
  EXPECT_EQ(kinds["features"], 2);
  EXPECT_EQ(kinds["no_features"], 4);
  EXPECT_LT(said["sliding"], plain["sliding"]);
  EXPECT_GE(said["after"]["minimum"], said["before"]["minimum"]);
  EXPECT_EQ(plain["parameters"]["kinds_by_user"]["corners"], 0);
  const auto both = json_of(smoothed({"--no-corner", "0,2", "--json"}));
  EXPECT_THAT(both["warnings"], Contains("--no-corner: vertex 0 stays: feature edges meet there"));
  const Output compared =
      run({"compare", in_, "--run", "dmo", "--run", "laplace", "--iterations", "1", "--boundary", "slide", "--corner", "12", "--json"});
  EXPECT_EQ(json_of(compared)["free"], plain["free"].get<int>() - 1);
}

TEST_F(KindsOnTheCommandLine, WhatCannotBeIsRefusedWithTheReason) {
  for (const auto& [words, reason] : {std::pair(std::vector<std::string>{"--corner", "125"}, "--corner 125: there is no vertex 125"),
                                      {{"--no-corner", "0"}, "--no-corner vertex 0 stays: feature edges meet there"},
                                      {{"--feature", "0-2"}, "--feature 0-2: there is no edge 0-2: those of 0 lead to 1, 5, 25"},
                                      {{"--no-feature", "chain:6-7"}, "--no-feature chain:6-7: this is no feature edge"},
                                      {{"--feature", "rim"}, "--feature rim: the mesh has no groups"}}) {
    const Output output = smoothed(words);
    EXPECT_EQ(output.code, 2) << words[0];
    EXPECT_THAT(output.err, HasSubstr(reason));
  }
  EXPECT_THAT(run({"smooth", "--help"}).out, HasSubstr("--no-feature EDGES"));
}

TEST_F(KindsOnTheCommandLine, ACheckpointKnowsThem) {
  EXPECT_EQ(smoothed({"--corner", "12", "--checkpoint", folder_ / "c", "--checkpoint-every", "0"}).code, 0);
  std::vector<std::string> words{"smooth", in_,          "-o",    folder_ / "b.vtk", "--iterations",
                                 "5",      "--boundary", "slide", "--resume",        folder_ / "c"};
  EXPECT_EQ(run(words).code, 2) << "without the corner it is another run";
  words.insert(words.end(), {"--corner", "12"});
  EXPECT_EQ(run(words).code, 0);
}

}  // namespace
}  // namespace dmoscope::test
