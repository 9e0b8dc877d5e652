// The best of the iterations that a run passes through, to which a converged run goes back.

#include "core/run/best_state.h"

#include <initializer_list>
#include <memory>

#include <gmock/gmock.h>

#include "core/base/same_bits.h"
#include "core/run/ending.h"
#include "core/run/run.h"
#include "tests/session/spoken_session.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Values {
  double minimum = 0.0, mean = 0.0, movable = 0.0;
  Index inverted = 0;
};

std::vector<IterationRecord> course(std::initializer_list<Values> all) {
  std::vector<IterationRecord> records;
  for (const Values& values : all) {
    IterationRecord record{records.size(), {}, 1, 0.0};
    record.statistics.minimum = values.minimum;
    record.statistics.mean = values.mean;
    record.statistics.movable_minimum = values.movable == 0.0 ? values.minimum : values.movable;
    record.statistics.inverted = values.inverted;
    records.push_back(record);
  }
  return records;
}

TEST(BestState, OfAnOptimisingMethodIsByTheMinimumThenByTheMean) {
  const RunParameters dmo;
  EXPECT_EQ(best_iteration(dmo, course({{0.3, 0.8}, {0.4, 0.7}, {0.4, 0.6}, {0.4, 0.5}})), 1U) << "the mean falls after the last rise";
  EXPECT_EQ(best_iteration(dmo, course({{0.3, 0.8}, {0.4, 0.7}, {0.4, 0.72}, {0.4, 0.5}})), 2U);
  EXPECT_EQ(best_iteration(dmo, course({{0.3, 0.8}, {0.4, 0.7}, {0.4, 0.6}, {0.5, 0.5}})), 3U) << "no mean is worth a minimum";
  EXPECT_EQ(best_iteration(dmo, course({{0.3, 0.8}, {0.4, 0.7}, {0.4, 0.7}})), 2U) << "among equals the last";
  EXPECT_EQ(best_iteration(dmo, course({{0.2, 0.8, 0.3}, {0.2, 0.7, 0.4}, {0.2, 0.6, 0.4}})), 1U) << "the movable minimum counts";
  EXPECT_EQ(best_iteration(dmo, course({{-0.1, 0.8, 0, 3}, {-0.1, 0.7, 0, 2}, {-0.1, 0.6, 0, 2}})), 1U) << "and what is untangled";
}

TEST(BestState, AMeanIsNotPaidForByWhatRoundingAddsToTheMinimum) {
  RunParameters best;
  best.then_joint.emplace();
  best.then_mean.emplace();
  EXPECT_EQ(best_iteration(best, course({{0.3, 0.8}, {0.3 + 1e-10, 0.5}})), 0U);
  EXPECT_EQ(best_iteration(best, course({{0.3, 0.8}, {0.3 + 1e-5, 0.5}})), 1U);
  EXPECT_EQ(best_iteration(best, course({{1e-7, 0.8}, {2e-7, 0.5}})), 1U) << "twice as good, however small";
}

TEST(BestState, JointMovesLoseWhereTheMeanFellAndNoMinimumRose) {
  RunParameters joint;
  joint.then_joint.emplace();
  const auto lose = [&joint](std::initializer_list<Values> all, bool jointly = true) {
    std::vector<IterationRecord> records = course(all);
    if (jointly) records[1].joint.emplace();
    return joint_moves_lose(joint, records);
  };
  EXPECT_TRUE(lose({{0.3, 0.8}, {0.3, 0.5}, {0.3, 0.5}}));
  EXPECT_FALSE(lose({{0.3, 0.8}, {0.3, 0.5}, {0.3, 0.5}}, false)) << "no joint move";
  EXPECT_FALSE(lose({{0.3, 0.8}, {0.4, 0.5}, {0.4, 0.5}})) << "the minimum rose";
  EXPECT_FALSE(lose({{0.2, 0.8, 0.3}, {0.2, 0.5, 0.4}})) << "that of what can move rose";
  EXPECT_FALSE(lose({{0.3, 0.8}, {0.3, 0.85}})) << "the mean rose";
}

/// The worst element has a corner between three vertices that stay; raises of others by joint moves count.
TEST(BestState, WhatJointMovesRaiseCountsThoughAnotherElementStaysWorse) {
  RunParameters dmo;
  dmo.then_joint.emplace();
  auto records = course({{0.1, 0.5}, {0.1, 0.7}, {0.1, 0.6}, {0.1, 0.65}, {0.1, 0.6}});
  EXPECT_EQ(best_iteration(dmo, records), 1U);
  for (const std::size_t joint : {1U, 2U}) records[joint].joint = JointFigures{};
  EXPECT_EQ(best_iteration(dmo, records), 3U) << "the last cluster, and then the greater mean";
  records[2].moved = 0;
  EXPECT_EQ(best_iteration(dmo, records), 1U) << "it moved nothing";
  records[0].statistics.mean = 0.8;
  EXPECT_EQ(best_iteration(dmo, records), 0U) << "with the same minimum nothing of the input's mean is given up";
  records[1].statistics.minimum = 0.09;
  EXPECT_EQ(best_iteration(dmo, records), 0U) << "no minimum is given up";
}

TEST(BestState, WhatIsNoRiseIsNoReasonToGiveUpTheMeanUnlessItAddsUp) {
  const RunParameters dmo;
  EXPECT_EQ(best_iteration(dmo, course({{0.4, 0.7}, {0.4 + 4e-7, 0.6}, {0.4 + 8e-7, 0.5}})), 0U);
  EXPECT_EQ(best_iteration(dmo, course({{0.4, 0.7}, {0.4 + 4e-7, 0.6}, {0.4 + 8e-7, 0.5}, {0.4 + 12e-7, 0.4}})), 3U);
}

/// The iteration that the next phase begins with.
std::uint64_t next_begins_at(const RunParameters& parameters, const std::vector<IterationRecord>& records) {
  BestState best(parameters, BestState::For::NextPhase);
  for (const IterationRecord& record : records) best.take(record);
  return best.iteration();
}

TEST(BestState, NothingOfTheMinimumIsGivenUpWhereAPhaseFollows) {
  RunParameters mean, joint;
  mean.then_mean.emplace();
  joint.then_joint.emplace();
  for (const RunParameters& dmo : {mean, joint}) {
    EXPECT_EQ(next_begins_at(dmo, course({{0.4, 0.7}, {0.4 + 4e-7, 0.6}, {0.4 + 4e-7, 0.5}})), 1U);
    EXPECT_EQ(next_begins_at(dmo, course({{0.4, 0.7}, {0.4 + 4e-7, 0.5}, {0.4 + 4e-7, 0.6}, {0.4 + 4e-7, 0.55}, {0.4, 0.7}})), 2U);
  }
}

/// The raised mean never falls, but the statistics' mean may.
TEST(BestState, OfThePhaseThatRaisesAMeanTheLastIsTheBest) {
  RunParameters mean;
  mean.then_mean.emplace();
  auto records = course({{0.2, 0.5}, {0.4, 0.6}, {0.4, 0.8}, {0.4, 0.79}, {0.39, 0.9}});
  for (std::size_t i = 2; i < records.size(); ++i) records[i].raises_mean = true;
  EXPECT_EQ(best_iteration(mean, records), 3U);
  mean.mean = MeanKind::Arithmetic;
  EXPECT_EQ(best_iteration(mean, records), 2U);
}

TEST(BestState, OfOtherMethodsEveryValueCountsInTurn) {
  const RunParameters laplace{.method = "laplace"};
  EXPECT_EQ(best_iteration(laplace, course({{0.3, 0.8}, {0.5, 0.7}, {0.4, 0.9}})), 1U);
  EXPECT_EQ(best_iteration(laplace, course({{0.3, 0.8}, {0.2, 0.9}})), 0U);
  EXPECT_EQ(best_iteration(laplace, course({{0.3, 0.8, 0, 1}, {0.2, 0.7}})), 1U);
}

class EndAtBest : public testing::SpokenSession {
 protected:
  /// Opens a mesh whose mean goes on falling after the minimum's last rise.
  void open() { say("generate random 400"); }
  const dmoscope::Run& run() { return session_.active(); }
};

TEST_F(EndAtBest, AConvergedRunGoesBackAndSaysSo) {
  open();
  say("until-converged best");
  const std::uint64_t last = run().history().records().size() - 1, best = best_iteration(run().parameters(), run().history().records());
  ASSERT_LT(best, last) << "else this test shows nothing";
  EXPECT_EQ(run().moment(), (Moment{best}));
  ASSERT_TRUE(run().last_outcome());
  EXPECT_EQ(run().last_outcome()->best, best);
  EXPECT_EQ(run().last_outcome()->ended, last);
  EXPECT_THAT(run().last_outcome()->sentence(), HasSubstr("back at iteration " + std::to_string(best)));
  const Statistics here = run().statistics(), end = run().history().records().back().statistics;
  EXPECT_GT(here.mean, end.mean);
  EXPECT_GT(here.minimum, end.minimum - kLeastRise);
  // The positions are those of that iteration, bit for bit.
  const std::vector<Vec3> gone_back(run().positions().begin(), run().positions().end());
  say("reset");
  say("run " + std::to_string(best));
  EXPECT_TRUE(same_bits(run().positions(), gone_back));
  say("undo");
  say("undo");
  EXPECT_TRUE(same_bits(run().positions(), gone_back));
  EXPECT_TRUE(run().last_outcome());
}

TEST_F(EndAtBest, NothingIsComputedAgainWithoutAHistory) {
  open();
  session_.set_history_budget(0);
  dmoscope::Run& active = session_.active();
  const Outcome outcome = active.until_converged({}, progress_);
  const std::uint64_t best = best_iteration(active.parameters(), active.history().records());
  ASSERT_LT(best, outcome.ended);
  EXPECT_EQ(active.moment(), (Moment{outcome.ended})) << "until it is told to";
  EXPECT_TRUE(active.history().kept(best));
  active.end_at_best(progress_);
  EXPECT_EQ(active.moment(), (Moment{best}));
  const std::vector<Vec3> here(active.positions().begin(), active.positions().end());
  say("reset");
  say("run " + std::to_string(best));
  EXPECT_TRUE(same_bits(active.positions(), here));
}

TEST_F(EndAtBest, ANumberOfIterationsThatWasAskedForIsDone) {
  open();
  say("run 40");
  EXPECT_EQ(run().moment(), (Moment{40}));
  EXPECT_FALSE(run().last_outcome()->best);
}

TEST_F(EndAtBest, WhoDoesNotAskForTheBestStaysAtTheEnd) {
  open();
  say("until-converged");
  EXPECT_EQ(run().moment(), (Moment{run().history().records().size() - 1}));
  say("each until-converged best");
  EXPECT_EQ(run().moment(), (Moment{best_iteration(run())}));
}

TEST_F(EndAtBest, LaterIterationsOfBeforeDoNotCount) {
  open();
  say("run 30");
  say("seek 2");
  say("until-converged best 1 3");
  EXPECT_LE(run().moment(), (Moment{5}));
}

TEST_F(EndAtBest, LaplaceIsToldToHaveMadeElementsWorse) {
  say("generate coast");
  say("method laplace");
  say("until-converged best 5 50");
  ASSERT_TRUE(run().last_outcome()->best);
  EXPECT_THAT(messages_, ::testing::Contains(HasSubstr("laplace may make elements worse: the best iteration was ")));
  EXPECT_THAT(messages_, ::testing::Each(Not(HasSubstr("('best' goes there)")))) << "it has gone there";
}

}  // namespace
}  // namespace dmoscope
