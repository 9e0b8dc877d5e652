// dmoscope smooth --combine and --then: results on real meshes, and messages.

#include <cmath>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

double number(const nlohmann::json& json) { return json.is_number() ? json.get<double>() : NAN; }

#define REQUIRE_SHARED(path, name)            \
  const std::string path = shared_mesh(name); \
  if (path.empty()) GTEST_SKIP() << "the shared meshes are not here"

TEST(CompositeObjective, JsonTellsOfThem) {
  const Folder folder;
  const std::string coast = sample("coast.14");
  const auto plain = smooth(coast, folder / "a.14", {"--iterations", "1"});
  EXPECT_TRUE(plain["combination"].is_null() && plain["then"].is_null() && plain["mean_since"].is_null());
  const auto metrics = smooth(coast, folder / "b.14", {"--iterations", "1", "--combine", "radius-ratio:0.4:min-angle"});
  EXPECT_EQ(metrics["metric"], "radius-ratio");
  EXPECT_EQ(metrics["combination"]["first"], "radius-ratio");
  EXPECT_EQ(metrics["combination"]["threshold"], 0.4);
  EXPECT_EQ(metrics["combination"]["second"], "min-angle");
  EXPECT_EQ(metrics["simd"], plain["simd"]);
  EXPECT_EQ(metrics["parameters"]["precision"], "double");
  EXPECT_EQ(plain["parameters"]["precision"], "float");
  const auto laplace = smooth(coast, folder / "l.14", {"--iterations", "1", "--method", "laplace"});
  EXPECT_EQ(laplace["parameters"]["precision"], "double") << "dmo's lanes alone are of floats";
  const auto density =
      smooth(coast, folder / "c.14",
             {"--iterations", "1", "--combine", "mean-ratio:0.5:density", "--size-function", "field:depth", "--stats", folder / "c.csv"});
  EXPECT_EQ(density["combination"]["size_function"], "field:depth");
  for (const char* key : {"size_correlation", "size_log_correlation"})
    for (const char* when : {"before", "after"}) EXPECT_TRUE(density["combination"][key][when].is_number()) << key << when;
  EXPECT_THAT(read_file(folder / "c.csv"), HasSubstr("\ndmo:mean-ratio:0.5:density:field,1,"));
  const Output person = run({"smooth", coast, "-o", folder / "d.14", "--combine", "mean-ratio:0.5:density", "--size-function", "h1:0,0"});
  for (const char* word : {"mean ratio > 0.5 · density h1", "log size", "correlation"}) EXPECT_THAT(person.out, HasSubstr(word));
}

TEST(CompositeObjective, WrongFieldsAreUsage) {
  const Folder folder;
  const Output output =
      run({"smooth", sample("coast.14"), "-o", folder / "out.14", "--combine", "mean-ratio:0.7:density", "--size-function", "field:salt"});
  EXPECT_EQ(output.code, 2);
  EXPECT_THAT(output.err, HasSubstr("depth"));
  EXPECT_FALSE(exists(folder / "out.14"));
}

TEST(CompositeObjective, ThreadsDoNotMatter) {
  const Folder folder;
  const std::vector<std::vector<std::string>> kinds{
      {"--then", "mean", "--iterations", "12"},
      {"--combine", "mean-ratio:0.5:density", "--size-function", "field:depth", "--iterations", "3"}};
  for (auto arguments : kinds) {
    arguments.insert(arguments.end(), {"--threads", "1"});
    smooth(sample("coast.14"), folder / "one.14", arguments);
    arguments.back() = std::string("3");
    smooth(sample("coast.14"), folder / "three.14", arguments);
    EXPECT_TRUE(read_file(folder / "one.14") == read_file(folder / "three.14"));
  }
}

TEST(CompositeObjective, TheMeanOfEastRisesAndItsMinimumStays) {
  REQUIRE_SHARED(east, "ocean/east.14");
  const Folder folder;
  const auto alone = smooth(east, folder / "alone.14", {"--iterations", "10", "--geographic", "off"});
  const auto json = smooth(east, folder / "out.14",
                           {"--then", "arithmetic-mean", "--until-converged", "--stats", folder / "s.csv", "--geographic", "off"});
  EXPECT_NEAR(number(json["after"]["minimum"]), number(alone["after"]["minimum"]), 0.001);
  EXPECT_GE(number(json["after"]["mean"]), 0.953);
  ASSERT_TRUE(json["mean_since"].is_number());
  const Table table = read_table(folder / "s.csv");
  for (std::size_t i = json["mean_since"].get<std::size_t>() + 1; i < table.rows.size(); ++i) {
    EXPECT_GE(table.number(i, "min_quality"), table.number(i - 1, "min_quality"));
    EXPECT_GE(table.number(i, "mean_quality"), table.number(i - 1, "mean_quality") - 1e-15);
    EXPECT_EQ(table.number(i, "inverted"), 0.0);
  }
}

TEST(CompositeObjective, TheMeanOfBahamasRisesUntilConverged) {
  REQUIRE_SHARED(bahamas, "ocean/bahamas.14");
  const Folder folder;
  const auto json = smooth(bahamas, folder / "out.14", {"--then", "mean", "--until-converged", "--patience", "20"});
  EXPECT_GE(number(json["after"]["mean"]), 0.978);
  EXPECT_GE(number(json["after"]["minimum"]), 0.7687);
  const auto as_long =
      smooth(bahamas, folder / "out.14", {"--then", "mean", "--until-converged", "--patience", "20", "--max-iterations", "9999"});
  EXPECT_EQ(json["mean_since"], as_long["mean_since"]) << "when the phase begins does not depend on when the run is to stop";
}

TEST(CompositeObjective, AMetricIsNotCombinedWithItself) {
  const Folder folder;
  const Output output =
      run({"smooth", sample("annulus.off"), "-o", folder / "out.off", "--combine", "mean-ratio:0.7:mean-ratio", "--iterations", "1"});
  EXPECT_NE(output.code, 0);
  EXPECT_THAT(output.err, ::testing::HasSubstr("mean-ratio cannot be combined with itself"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.off"));
}

/// The paper's Fig. 9.
TEST(CompositeObjective, TheSizesOfBahamasFollowTheDistance) {
  REQUIRE_SHARED(bahamas, "ocean/bahamas.14");
  const Folder folder;
  for (const auto& [size, plain, logarithmic] : {std::tuple{"h1:39143,52462", 0.4, 0.65}, {"h2:39143,52462", 0.55, 0.3}}) {
    const auto json =
        smooth(bahamas, folder / "out.14", {"--combine", "mean-ratio:0.7:density", "--size-function", size, "--iterations", "20"});
    EXPECT_GE(number(json["after"]["minimum"]), 0.7);
    EXPECT_EQ(json["after"]["inverted"], 0);
    const auto& correlation = json["combination"]["size_correlation"];
    const auto& of_logarithms = json["combination"]["size_log_correlation"];
    EXPECT_LT(number(correlation["before"]), 0.1);
    EXPECT_LT(number(of_logarithms["before"]), 0.1);
    EXPECT_GT(number(correlation["after"]), plain) << size;
    EXPECT_GT(number(of_logarithms["after"]), logarithmic) << size;
  }
}

}  // namespace
}  // namespace dmoscope::test
