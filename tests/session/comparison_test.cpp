// Commands about all runs at once.

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/engine/command_end.h"
#include "core/engine/engine.h"
#include "core/smooth/execution/method_table.h"
#include "tests/session/spoken_session.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;

class Comparison : public testing::SpokenSession {
 protected:
  [[nodiscard]] std::vector<Vec3> positions(std::size_t k) {
    const auto now = session_.run(k).positions();
    return {now.begin(), now.end()};
  }
  [[nodiscard]] std::vector<std::uint64_t> iterations() {
    std::vector<std::uint64_t> all;
    for (std::size_t k = 0; k < session_.run_count(); ++k) all.push_back(session_.run(k).moment().iteration);
    return all;
  }
};

void expect_same(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
}

std::size_t metrics_of_triangles() {
  return static_cast<std::size_t>(
      std::ranges::count_if(metric_table(), [](const MetricInfo& metric) { return metric.defined_for(ElementKind::Triangle); }));
}

TEST_F(Comparison, EveryRunStepsAsIfItWereAlone) {
  say("generate random 300");
  say("add-run dmo:min-angle");
  say("run 1");
  say("select-run 1");
  say("each run 3");
  EXPECT_THAT(iterations(), ::testing::ElementsAre(3U, 4U));
  EXPECT_EQ(session_.active_index(), 0U);
  const auto first = positions(0), second = positions(1);
  say("generate random 300");
  say("run 3");
  expect_same(first, positions(0));
  say("add-run dmo:min-angle");
  say("run 4");
  expect_same(second, positions(1));
  say("each back");
  EXPECT_THAT(iterations(), ::testing::ElementsAre(2U, 3U));
  say("each seek 4");
  EXPECT_THAT(iterations(), ::testing::ElementsAre(4U, 4U));
  expect_same(second, positions(1));
  say("each reset");
  EXPECT_THAT(iterations(), ::testing::ElementsAre(0U, 0U));
  expect_same(positions(0), session_.input()->mesh.positions);
}

TEST_F(Comparison, EveryRunConvergesAndSaysHow) {
  say("generate annulus 300");
  say("add-run dmo:radius-ratio");
  messages_.clear();
  say("each until-converged 5 100");
  ASSERT_EQ(messages_.size(), 2U);
  EXPECT_THAT(messages_[0], HasSubstr("dmo · mean ratio: converged"));
  EXPECT_THAT(messages_[1], HasSubstr("dmo · radius ratio: converged"));
  for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(session_.run(k).last_outcome().has_value());
}

TEST_F(Comparison, EveryMetricIsOneRunAndTheSameIteration) {
  say("generate random 200");
  say("levels 2");
  say("run 2");
  say("compare metrics");  // with as many iterations as the active run
  EXPECT_EQ(session_.run_count(), metrics_of_triangles());
  EXPECT_EQ(session_.active_index(), 0U);
  std::set<Metric> metrics;
  for (std::size_t k = 0; k < session_.run_count(); ++k) {
    metrics.insert(session_.run(k).parameters().metric);
    EXPECT_EQ(session_.run(k).parameters().search.levels, 2);
    EXPECT_EQ(session_.run(k).moment(), Moment{2});
  }
  EXPECT_EQ(metrics.size(), metrics_of_triangles());
  say("compare metrics 3");  // nothing occurs twice
  EXPECT_EQ(session_.run_count(), metrics_of_triangles());
  for (const std::uint64_t iteration : iterations()) EXPECT_EQ(iteration, 3U);
  say("undo");
  for (const std::uint64_t iteration : iterations()) EXPECT_EQ(iteration, 2U);
  say("undo");
  EXPECT_EQ(session_.run_count(), 1U);
}

TEST_F(Comparison, OnlyMetricsOfAllElementsAreCompared) {
  say("generate quads 100");
  say("compare metrics 1");
  std::size_t defined = 0;
  for (const MetricInfo& metric : metric_table()) defined += metric.defined_for(ElementKind::Quadrilateral) ? 1U : 0U;
  EXPECT_EQ(session_.run_count(), defined);
}

TEST_F(Comparison, EveryMethodThatCanBe) {
  say("generate random 200");
  say("compare methods 2");
  EXPECT_EQ(session_.run_count(), method_table().size());
  std::set<std::string> methods;
  for (std::size_t k = 0; k < session_.run_count(); ++k) methods.insert(session_.run(k).parameters().method);
  EXPECT_EQ(methods.size(), method_table().size());
  say("generate random 200");
  say("metric rectangularity");
  messages_.clear();
  say("compare methods 1");
  std::size_t possible = 0;
  for (const MethodInfo& method : method_table()) possible += method.joint ? 0U : 1U;
  EXPECT_EQ(session_.run_count(), possible);
  EXPECT_EQ(messages_.size(), method_table().size() - possible);  // a reason for each
}

/// Phases after another method would hide what it does; the active run keeps its own.
TEST_F(Comparison, OtherMethodsGoWithoutTheActiveRunsPhases) {
  say("generate random 200");
  say("make-good");
  say("compare with laplace dmo:min-angle 3");
  ASSERT_EQ(session_.run_count(), 3U);
  EXPECT_TRUE(session_.run(0).parameters().then_mean);
  EXPECT_EQ(session_.run(1).parameters().method, "laplace");
  EXPECT_FALSE(session_.run(1).parameters().then_mean || session_.run(1).parameters().then_joint);
  EXPECT_TRUE(session_.run(2).parameters().then_mean) << "the same method, by another metric";
  say("compare methods 1");
  for (std::size_t k = 3; k < session_.run_count(); ++k) EXPECT_FALSE(session_.run(k).parameters().then_mean) << k;
  say("generate random 100");
  EXPECT_FALSE(session_.active().parameters().then_mean) << "a recipe is chosen for a mesh";
}

TEST_F(Comparison, OrdersDifferInNothingElse) {
  say("generate random 300");
  say("compare orders 3 4");
  ASSERT_EQ(session_.run_count(), 4U);
  EXPECT_FALSE(session_.run(0).parameters().order.seed.has_value());
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_EQ(session_.run(k).parameters().order.seed, k);
    EXPECT_NE(session_.run(k).colouring().order, session_.run(0).colouring().order);
  }
  EXPECT_TRUE(fails("compare orders"));
  EXPECT_TRUE(fails("compare orders 0"));
  EXPECT_TRUE(fails("compare orders 100000"));
  EXPECT_TRUE(fails("compare colours"));
  EXPECT_TRUE(fails("compare methods 1 2"));
  EXPECT_TRUE(fails("each dance"));
  EXPECT_EQ(session_.run_count(), 4U);
}

TEST_F(Comparison, EveryComparisonGoesOnUntilConverged) {
  for (const char* line :
       {"compare methods converged", "compare metrics converged", "compare orders 2 converged", "compare with laplace converged"}) {
    say("generate random 60");
    say(line);
    ASSERT_GT(session_.run_count(), 1U) << line;
    for (std::size_t k = 0; k < session_.run_count(); ++k) EXPECT_TRUE(session_.run(k).last_outcome().has_value()) << line << k;
  }
  EXPECT_TRUE(fails("compare converged"));
  EXPECT_TRUE(fails("compare methods 2 converged"));
}

TEST_F(Comparison, NothingIsComparedWithoutAMesh) {
  EXPECT_TRUE(fails("each run 1"));
  EXPECT_TRUE(fails("compare metrics"));
}

TEST_F(Comparison, WhatACancelLeftCanBeDoneAgain) {
  say("generate coast 600");
  const SessionPoint before = session_.point();
  std::uint64_t visits = 0;
  session_.observe([&](const dmoscope::Run& run) {
    if (run.moment().iteration >= 2 && ++visits == 5) progress_.request_cancel();
  });
  context_.done.clear();
  EXPECT_THROW(say("compare metrics 50"), Cancelled);
  progress_.clear_cancel();
  session_.observe({});
  ASSERT_EQ(session_.run_count(), metrics_of_triangles());
  std::vector<std::vector<Vec3>> left;
  std::vector<Moment> moments;
  for (std::size_t k = 0; k < session_.run_count(); ++k) {
    left.push_back(positions(k));
    moments.push_back(session_.run(k).moment());
  }
  EXPECT_GT(moments.front().iteration, 1U);
  const std::vector<std::string> again = commands_from(session_, before, context_.done);
  say("undo");
  EXPECT_EQ(session_.run_count(), 1U);
  for (const std::string& line : again) say(line);
  ASSERT_EQ(session_.run_count(), metrics_of_triangles());
  EXPECT_EQ(session_.active_index(), 0U);
  for (std::size_t k = 0; k < session_.run_count(); ++k) {
    EXPECT_EQ(session_.run(k).moment(), moments[k]);
    expect_same(left[k], positions(k));
  }
}

TEST(ProgressPart, IsAShareOfTheWhole) {
  Progress progress;
  {
    const Progress::Part outer(progress, 1, 4);  // the second quarter
    progress.set(0.5);
    EXPECT_DOUBLE_EQ(progress.fraction(), 0.375);
    {
      const Progress::Part inner(progress, 1, 2);  // its second half
      progress.set(0.0);
      EXPECT_DOUBLE_EQ(progress.fraction(), 0.375);
      progress.set(1.0);
      EXPECT_DOUBLE_EQ(progress.fraction(), 0.5);
    }
    progress.set(0.0);
    EXPECT_DOUBLE_EQ(progress.fraction(), 0.25);
  }
  progress.set(1.0);
  EXPECT_DOUBLE_EQ(progress.fraction(), 1.0);
}

}  // namespace
}  // namespace dmoscope
