// Formulas and targets as commands, in saved sessions, and back.

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/quality/defined_metric.h"
#include "core/session/state_file.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class DefinedMetricsInASession : public testing::SpokenSession {
 protected:
  [[nodiscard]] std::string metric() { return std::string(info(session_.active().parameters().metric).name); }
  const test::TemporaryFolder folder_;
};

TEST_F(DefinedMetricsInASession, AreSavedWithTheirWords) {
  say("generate mixed 300");
  say("metric \"formula:\\\"My metric\\\"; if(det > 0, smin/smax, -1)@layers:input\"");
  EXPECT_EQ(metric(), "formula:\"My metric\"; if(det>0, smin/smax, -1)@layers:input");
  EXPECT_EQ(session_.shown(), session_.active().parameters().metric);
  say("run 3");
  const std::vector<Vec3> expected(session_.active().positions().begin(), session_.active().positions().end());
  const double minimum = session_.active().statistics().minimum;
  const std::string file = (folder_.path() / "a.dmoscope").string();
  say("save-state \"" + file + "\"");
  say("generate random 50");
  say("open-state \"" + file + "\"");
  EXPECT_EQ(metric(), "formula:\"My metric\"; if(det>0, smin/smax, -1)@layers:input");
  EXPECT_TRUE(same_bits(expected, session_.active().positions()));
  EXPECT_EQ(session_.active().statistics().minimum, minimum);
  say("back iteration");
  say("step iteration");
  EXPECT_TRUE(same_bits(expected, session_.active().positions()));
  EXPECT_THAT(session_.active().title(), HasSubstr("My metric"));
}

TEST_F(DefinedMetricsInASession, TargetsAreChangedAlone) {
  say("generate anisotropic 300");
  say("metric min-angle");
  say("target field");
  EXPECT_EQ(metric(), "min-angle@field");
  EXPECT_THAT(messages_, Contains(HasSubstr("elements by the metric field")));
  say("target ideal");
  EXPECT_EQ(metric(), "min-angle");
  say("target input:2");
  say("undo");
  EXPECT_EQ(metric(), "min-angle");
  say("combine mean-ratio:0.4:shape-size");
  say("target field");
  EXPECT_EQ(metric(), "mean-ratio@field");
  EXPECT_EQ(info(std::get<Metric>(session_.active().parameters().combination->second)).name, "shape-size@field");
  const std::string file = (folder_.path() / "b.dmoscope").string();
  say("run 1");
  say("save-state \"" + file + "\"");
  say("open-state \"" + file + "\"");
  EXPECT_EQ(metric(), "mean-ratio@field");
  EXPECT_EQ(info(std::get<Metric>(session_.active().parameters().combination->second)).name, "shape-size@field");
}

TEST_F(DefinedMetricsInASession, WhatCannotBeChangesNothing) {
  say("generate quads 100");
  EXPECT_THAT(why("metric \"formula:lmin/(lmax\""), HasSubstr("column 11: expected a sign or ')'"));
  EXPECT_THAT(why("metric formula:aera"), HasSubstr("did you mean area?"));
  EXPECT_THAT(why("target field"), HasSubstr("no metric field"));
  EXPECT_THAT(why("target wing:input"), HasSubstr("unknown group"));
  EXPECT_THAT(why("show mean-ratio@field"), HasSubstr("no metric field"));
  EXPECT_THAT(why("target nonsense"), HasSubstr("is no target"));
  EXPECT_EQ(metric(), "mean-ratio");
  EXPECT_EQ(session_.shown(), Metric::MeanRatio);
  // Another mesh may lack data that the metric needs: it begins with a metric that it supports.
  say("generate anisotropic 200");
  say("target field");
  say("generate quads 100");
  EXPECT_EQ(metric(), "mean-ratio");
  EXPECT_EQ(session_.shown(), Metric::MeanRatio);
}

TEST_F(DefinedMetricsInASession, AFormulaMayLieInAFile) {
  const std::string file = (folder_.path() / "m.txt").string();
  std::ofstream(file) << "# my metric\nq = lmin/lmax\nif(measure > 0, q, -q)\n";
  say("generate mixed 200");
  say("metric \"formula:@" + file + "\"");
  EXPECT_EQ(metric(), "formula:q=lmin/lmax; if(measure>0, q, -q)");
  std::ofstream(file) << "q = lmin/lmax\nif(measure > 0, q, -p)\n";
  EXPECT_THAT(why("metric \"formula:@" + file + "\""), HasSubstr(file + ":2: column 21: unknown name 'p'"));
  EXPECT_THAT(why("metric \"formula:@" + file + ".not\""), HasSubstr(".not: No such file"));
}

TEST_F(DefinedMetricsInASession, CombinationsHaveColonsOfTheirOwn) {
  say("generate mixed 200");
  say("combine \"formula:smin/smax@aspect:2:30:0.25:shape-size@aspect:2:30\"");
  const RunParameters& p = session_.active().parameters();
  EXPECT_EQ(metric(), "formula:smin/smax@aspect:2:30");
  EXPECT_EQ(p.combination->threshold, 0.25);
  EXPECT_EQ(info(std::get<Metric>(p.combination->second)).name, "shape-size@aspect:2:30");
  EXPECT_THAT(why("combine mean-ratio:2:min-angle"), HasSubstr("threshold"));
  // The target has a number that could be a threshold.
  say("combine \"formula:det/norm^2:0.4:aspect@layers:input\"");
  say("target aspect:4:0.5");
  const std::string file = (folder_.path() / "c.dmoscope").string();
  say("save-state \"" + file + "\"");
  say("open-state \"" + file + "\"");
  EXPECT_EQ(metric(), "formula:det/norm^2@aspect:4:0.5");
  EXPECT_EQ(session_.active().parameters().combination->threshold, 0.4);
}

TEST_F(DefinedMetricsInASession, AMeshThatLacksTheTargetHasNoQualityByIt) {
  say("generate anisotropic 200");
  const auto with = session_.active().shared_input();
  say("generate random 60");
  const InputMesh& without = session_.active().input();
  const Metric metric = parse_metric("mean-ratio@field");
  const Statistics statistics =
      compute_statistics(without.quality_context(), without.mesh.positions, metric, std::span<const Index>{}, nullptr);
  EXPECT_TRUE(std::isnan(element_quality(without.quality_context(), without.mesh.positions, metric, 0)));
  EXPECT_FALSE(statistics.minimum < 1.0);
  EXPECT_FALSE(std::isnan(element_quality(with->quality_context(), with->mesh.positions, metric, 0)));
}

}  // namespace
}  // namespace dmoscope
