// --boundary slide on the command line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

TEST(BoundaryOnTheCommandLine, SlidesAndIsSaid) {
  const Folder folder;
  const std::string in = sample("coast.14");
  const auto held = smooth(in, folder / "a.14", {"--iterations", "10"});
  const auto slides = smooth(in, folder / "b.14", {"--iterations", "10", "--boundary", "slide"});
  EXPECT_EQ(held["sliding"], 0);
  EXPECT_GT(slides["sliding"], 0);
  EXPECT_EQ(slides["free"], held["free"].get<int>() + slides["sliding"].get<int>());
  EXPECT_EQ(slides["parameters"]["boundary"], "slide");
  EXPECT_GE(slides["after"]["minimum"], slides["before"]["minimum"]);
  for (const auto& json : {held, slides}) {
    EXPECT_EQ(json["held_by"]["quality"], json["after"]["minimum"]);
    EXPECT_GE(json["held_by"]["vertices"].size(), 3U);
    EXPECT_EQ(json["held_by"]["switch"].is_null(), json["held_by"]["would_raise_to"].is_null());
    EXPECT_THAT(json["held_by"]["sentence"].get<std::string>(), HasSubstr("is the worst of all"));
  }
  const Output said = run({"smooth", in, "-o", folder / "c.14", "--iterations", "1", "--boundary", "slide"});
  EXPECT_THAT(said.out, HasSubstr("slide along the boundary, and "));
  for (const auto& wrong : {std::vector<std::string>{"--boundary", "up"},
                            {"--boundary", "slide", "--corner-angle", "0"},
                            {"--boundary", "slide", "--max-deviation", "2"},
                            {"--boundary", "slide", "--method", "dvr"}}) {
    std::vector<std::string> words{"smooth", in, "-o", folder / "d.14"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(run(words).code, 2) << wrong.back();
  }
}

}  // namespace
}  // namespace dmoscope::test
