// Output of converged runs, with and without a second phase, judged by dmoscope quality on the files, over all kinds of meshes.

#include <algorithm>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

/// Three triangles round a free vertex, twice, far apart.
constexpr const char* kTwoIslands =
    "OFF\n8 6 0\n0 0 0\n4 0 0\n0 4 0\n0.5 0.6 0\n100 0 0\n104 0 0\n100 4 0\n102.5 0.3 0\n"
    "3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 5 7\n3 5 6 7\n3 6 4 7\n";

/// A mesh of a kind, made by `dmoscope generate`.
std::string made(const Folder& folder, const std::string& kind) {
  if (kind == "islands") return folder.file("islands.off", kTwoIslands);
  const std::string file = folder / (kind + ".vtk");
  EXPECT_EQ(run({"generate", kind, "--size", "300", "-o", file}).code, 0);
  return file;
}

struct Judged {
  double minimum = 0.0, mean = 0.0;
  int inverted = 0;
};

Judged judge(const std::string& file) {
  const Json all = json_of(run({"quality", file, "--metric", "mean-ratio", "--json"}));
  double minimum = 1.0, sum = 0.0, count = 0.0;
  for (const Json& metric : all["metrics"]) {
    minimum = std::min(minimum, metric["minimum"].get<double>());
    sum += metric["mean"].get<double>() * metric["elements"].get<double>();
    count += metric["elements"].get<double>();
  }
  return {minimum, sum / count, all["inverted"]};
}

Json converge(const std::string& in, const std::string& out, std::vector<std::string> how) {
  how.insert(how.begin(), {"smooth", in, "-o", out, "--backend", "cpu", "--until-converged", "--patience", "60", "--json"});
  return json_of(run(how));
}

class ThenMean : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, ThenMean,
                         ::testing::Values("random", "mixed", "tangled", "nested", "islands", "tetrahedra", "tangled-solids",
                                           "nested-solids"));

TEST_P(ThenMean, IsNoWorseThanTheBestOfTheFirstPhaseInTheFile) {
  const Folder folder;
  const std::string in = made(folder, GetParam());
  const Json best = converge(in, folder / "best.vtk", {}), raised = converge(in, folder / "raised.vtk", {"--then", "mean"});
  const Judged before = judge(in), first = judge(folder / "best.vtk"), second = judge(folder / "raised.vtk");
  EXPECT_NEAR(best["after"]["minimum"], first.minimum, 1e-12);
  EXPECT_NEAR(best["after"]["mean"], first.mean, 1e-9);
  EXPECT_NEAR(raised["after"]["minimum"], second.minimum, 1e-12);
  EXPECT_NEAR(raised["after"]["mean"], second.mean, 1e-9);
  EXPECT_LE(first.inverted, before.inverted);
  EXPECT_LE(second.inverted, first.inverted);
  EXPECT_GE(second.minimum, first.minimum);
  EXPECT_GE(second.mean, first.mean - 1e-12);
  if (first.inverted > 0) return;
  ASSERT_FALSE(raised["mean_since"].is_null());
  if (raised["mean_from"].is_null()) return;
  EXPECT_EQ(raised["mean_from"], best["written_iteration"]);
}

TEST_P(ThenMean, HasTheSameBytesWithOtherThreads) {
  const Folder folder;
  const std::string in = made(folder, GetParam());
  converge(in, folder / "one.vtk", {"--then", "mean", "--threads", "1"});
  converge(in, folder / "three.vtk", {"--then", "mean", "--threads", "3"});
  EXPECT_EQ(read_file(folder / "one.vtk"), read_file(folder / "three.vtk"));
}

/// The rows of a comparison are those of smooth's output, not of the plain runs' last iterations.
TEST_P(ThenMean, ComparedTheRunsStandAtTheirBest) {
  const Folder folder;
  const std::string in = made(folder, GetParam());
  const Json best = converge(in, folder / "best.vtk", {}), raised = converge(in, folder / "raised.vtk", {"--then", "mean"});
  const Output output = run({"compare", in, "--run", "dmo", "--run", "dmo,then mean", "--backend", "cpu", "--until-converged", "--patience",
                             "60", "--table", folder / "t.csv", "--json"});
  const Json all = json_of(output)["runs"];
  const Table table = read_table(folder / "t.csv");
  EXPECT_EQ(table.number(1, "min_quality"), all[0]["min_quality"].get<double>());
  EXPECT_EQ(table.number(1, "mean_quality"), all[0]["mean_quality"].get<double>());
  for (const auto& [row, file, smoothed] : {std::tuple(0U, "best.vtk", &best), {1U, "raised.vtk", &raised}}) {
    const Judged judged = judge(folder / file);
    EXPECT_NEAR(all[row]["min_quality"], judged.minimum, 1e-12);
    EXPECT_NEAR(all[row]["mean_quality"], judged.mean, 1e-9);
    EXPECT_EQ(all[row]["judged_iteration"], (*smoothed)["written_iteration"]);
    EXPECT_EQ(all[row]["iterations"], (*smoothed)["iterations"]) << "all that were done count as its cost";
  }
}

TEST(ThenMeanSays, WhereTheSecondPhaseBeginsAndWhereAComparisonStands) {
  const Folder folder;
  const std::string in = made(folder, "random");
  const Json best = converge(in, folder / "best.vtk", {});
  const std::size_t written = best["written_iteration"];
  ASSERT_LT(written, best["iterations"].get<std::size_t>()) << "else this test shows nothing";
  const std::vector<std::string> how{"--backend", "cpu", "--until-converged", "--patience", "60"};
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), how.begin(), how.end());
    return run(arguments).out;
  };
  EXPECT_THAT(with({"smooth", in, "-o", folder / "out.vtk", "--then", "mean"}),
              HasSubstr(fmt::format("begins with the state of iteration {}, the best one before", written)));
  EXPECT_THAT(with({"compare", in, "--run", "dmo", "--run", "laplace"}),
              HasSubstr(fmt::format("back at iteration {}, the best one", written)));
}

/// A hybrid mesh whose mean fell from 0.938 to 0.844 in the first phase, and came back to 0.922 only when the second began there.
TEST(ThenMeanSays, OvertHybridKeepsTheMeanOfItsBestIteration) {
  const std::string overt = shared_mesh("mixed2d/overt_hyb_1.vtk");
  if (overt.empty()) GTEST_SKIP() << "no shared meshes beside this checkout";
  const Folder folder;
  const std::string out = folder / "out.vtk";
  ASSERT_EQ(run({"smooth", overt, "-o", out, "--backend", "cpu", "--until-converged", "--then", "mean"}).code, 0);
  const Judged judged = judge(out);
  EXPECT_GT(judged.minimum, 0.62) << "0.620 to 0.633, as the last bits of the input fall";
  EXPECT_GT(judged.mean, 0.955);
}

TEST(Recipe, BestIsNoLowerThanDmoAloneAndSaysWhatHoldsIt) {
  const Folder folder;
  for (const std::string kind : {"random", "mixed", "tetrahedra"}) {
    const std::string input = made(folder, kind), alone = folder / (kind + "_dmo.vtk"), best = folder / (kind + "_best.vtk");
    (void)run({"smooth", input, "-o", alone, "--until-converged"});
    const Json told = json_of(run({"smooth", input, "-o", best, "--recipe", "best", "--hints", "full", "--json"}));
    EXPECT_GE(judge(best).minimum, judge(alone).minimum) << kind;
    EXPECT_EQ(told["then"], "joint,mean");
    EXPECT_FALSE(told["joint_over"].is_null());
    ASSERT_TRUE(told["held_by"]["certificate"].is_object()) << kind;
    // A quadrilateral of the mixed mesh is held by a corner that no vertex moves: the certificate is that of the next.
    const bool of_another = told["held_by"]["certificate"]["reaches"].get<double>() > told["held_by"]["quality"].get<double>() * 1.01;
    EXPECT_EQ(of_another, kind == "mixed") << kind;
  }
  const std::string input = made(folder, "random"), output = folder / "none.vtk";
  EXPECT_NE(run({"smooth", input, "-o", output, "--recipe", "best", "--then", "mean"}).code, 0);
  EXPECT_NE(run({"smooth", input, "-o", output, "--recipe", "worst"}).code, 0);
}

}  // namespace
}  // namespace dmoscope::test
