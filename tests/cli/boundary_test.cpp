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
    if (json["held_by"]["switch"].is_null()) {
      EXPECT_TRUE(json["held_by"]["tried"].is_null());
    }
    EXPECT_THAT(json["held_by"]["sentence"].get<std::string>(), HasSubstr("is the worst of all"));
  }
  const Output said = run({"smooth", in, "-o", folder / "c.14", "--iterations", "1", "--boundary", "slide"});
  EXPECT_THAT(said.out, HasSubstr("slide along the boundary, and "));
  for (const auto& wrong : {std::vector<std::string>{"--boundary", "up"},
                            {"--boundary", "slide", "--corner-angle", "0"},
                            {"--boundary", "slide", "--max-deviation", "2"}}) {
    std::vector<std::string> words{"smooth", in, "-o", folder / "d.14"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(run(words).code, 2) << wrong.back();
  }
}

/// A coarse can slides on a finer one, and `quality` tells how near it stays.
TEST(BoundaryOnTheCommandLine, SlidesOnTheSurfaceOfAnotherMesh) {
  const Folder folder;
  const std::string fine = folder / "fine.off", coarse = folder / "coarse.off", out = folder / "out.off";
  ASSERT_EQ(run({"generate", "can", "--size", "4000", "-o", fine}).code, 0);
  ASSERT_EQ(run({"generate", "can", "--size", "400", "--seed", "3", "-o", coarse}).code, 0);
  const auto own = smooth(coarse, out, {"--iterations", "5"});
  const auto on = smooth(coarse, out, {"--iterations", "5", "--surface", fine});
  EXPECT_GT(on["after"]["minimum"], on["before"]["minimum"]);
  EXPECT_NE(on["after"]["mean"], own["after"]["mean"]);
  const auto before = json_of(run({"quality", coarse, "--surface", fine, "--json"}));
  const auto near = json_of(run({"quality", out, "--surface", fine, "--json"}));
  EXPECT_GT(near["surface"]["deviation"], 0.0);
  EXPECT_LT(near["surface"]["share_of_size"], 0.03);  // chords of a coarse can
  // Vertices on the rims that gain nothing by moving still stand on the circle, beyond the chords of the finer one.
  EXPECT_LT(near["surface"]["not_over_it"], before["surface"]["not_over_it"]);
  EXPECT_EQ(near["inverted"], 0);
  EXPECT_THAT(run({"quality", out, "--surface", fine}).out, HasSubstr("on fine.off: at most"));

  for (const char* verb : {"smooth", "compare"}) {
    std::vector<std::string> words{verb, sample("coast.14"), "--surface", fine};
    if (std::string(verb) == "smooth")
      words.insert(words.end(), {"-o", folder / "no.14"});
    else
      words.insert(words.end(), {"--run", "dmo"});
    const Output refused = run(words);
    EXPECT_EQ(refused.code, 2) << verb;
    EXPECT_THAT(refused.err, HasSubstr("planar")) << verb;
  }
  EXPECT_EQ(run({"smooth", coarse, "-o", fine, "--surface", fine}).code, 2) << "it would write over the surface";
  EXPECT_EQ(run({"smooth", coarse, "-o", out, "--surface", folder / "none.off"}).code, 3);
}

}  // namespace
}  // namespace dmoscope::test
