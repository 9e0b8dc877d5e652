// The phase that raises the mean: its start, its promises, and the same bits of a run that passes its start both ways.

#include <cstring>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/commands/session_commands.h"
#include "core/run/phases.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "core/session/state_file.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using testing::Cells;
using ::testing::HasSubstr;
using testing::input;
using testing::lattice;

/// Records with these minima, equal to the movable ones; some vertex moved in each.
std::vector<IterationRecord> records(const std::vector<double>& minima) {
  std::vector<IterationRecord> all;
  for (const double minimum : minima) {
    IterationRecord& record = all.emplace_back();
    record.iteration = all.size() - 1;
    record.statistics.minimum = record.statistics.movable_minimum = minimum;
    record.moved = 1;
  }
  return all;
}

TEST(PhaseSwitchDetector, AMethodOfDirectionsIsNotAtRestWhileAnotherOneIsLeft) {
  std::vector<IterationRecord> rising = records({0.1, 0.2, 0.3, 0.4, 0.5});
  for (const std::size_t i : {1UL, 3UL, 4UL}) rising[i].moved = 0;
  const PhaseBegin patient{.patience = 4};
  EXPECT_EQ(PhaseSwitchDetector().find(patient, rising, 1), 1U);
  EXPECT_EQ(PhaseSwitchDetector().find(patient, rising, 2), 4U);
  EXPECT_EQ(PhaseSwitchDetector().find(patient, rising, std::nullopt), std::nullopt);
}

/// A vertex that is at its best along x but not along y: the first sweep finds nothing to do.
TEST(PhaseSwitchDetector, DvrAlongTheAxesGoesOnAfterASweepThatFoundNothing) {
  Mesh mesh;
  mesh.positions = {{1, 0, 0},  {0.5, 0.8660254, 0}, {-0.5, 0.8660254, 0}, {-1, 0, 0}, {-0.5, -0.8660254, 0}, {0.5, -0.8660254, 0},
                    {0, 0.3, 0}};
  for (Index i = 0; i < 6; ++i) testing::add(mesh, {i, (i + 1) % 6, 6});
  RunParameters parameters{.method = "dvr"};
  parameters.options.directions = Directions::Axes;
  dmoscope::Run run(input(std::move(mesh)), parameters, std::make_shared<ThreadPool>(1), 0);
  Progress progress;
  const Outcome outcome = run.until_converged({}, progress);
  EXPECT_EQ(outcome.reason, StopReason::NothingMoved);
  EXPECT_GE(outcome.iterations, 4U);  // x, y, and both again in vain
  EXPECT_GT(run.statistics().minimum, 0.9999);
}

TEST(PhaseSwitchDetector, ComesWhenTheMinimumHasNotRisenForSoLong) {
  const auto rising = records({0.1, 0.2, 0.3, 0.4});
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 2}, rising), std::nullopt);
  const auto rested = records({0.1, 0.2, 0.2, 0.3, 0.3, 0.3, 0.4});
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 1}, rested), 2U);
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 2}, rested), 5U);
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 3}, rested), std::nullopt);
}

TEST(PhaseSwitchDetector, AStillIterationEndsThePhaseAndAMovableMinimumDelaysIt) {
  auto still = records({0.1, 0.2, 0.3});
  still[1].moved = 0;
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 5}, still), 1U);
  auto movable = records({0.1, 0.1, 0.1, 0.1, 0.1});
  for (std::size_t i = 0; i < 3; ++i) movable[i].statistics.movable_minimum = 0.2 + 0.1 * static_cast<double>(i);
  movable[3].statistics.movable_minimum = movable[4].statistics.movable_minimum = 0.4;
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 1}, movable), 3U);
}

TEST(PhaseSwitchDetector, FollowsAnotherPath) {
  PhaseSwitchDetector turn;
  EXPECT_EQ(turn.find({.patience = 2}, records({0.1, 0.2, 0.2, 0.2})), 3U);
  turn.forget_after(3);
  EXPECT_EQ(turn.find({.patience = 2}, records({0.1, 0.2, 0.2, 0.2})), 3U);
  turn.forget_after(1);
  EXPECT_EQ(turn.find({.patience = 2}, records({0.1, 0.2, 0.2, 0.2})), 3U);
  turn.forget_after(1);
  EXPECT_EQ(turn.find({.patience = 2}, records({0.1, 0.2, 0.3, 0.3})), std::nullopt);
  EXPECT_EQ(turn.find({.patience = 2}, records({0.1, 0.2, 0.3, 0.3, 0.3})), 4U);
}

TEST(PhaseSwitchDetector, LetsAttemptsToUntangleComeFirst) {
  auto tangled = records({-0.3, -0.3, -0.3, -0.3, 0.1, 0.1, 0.1});
  for (std::size_t i = 0; i < 4; ++i) tangled[i].statistics.inverted = 2;
  tangled[2].moved = 0;  // nothing moves in this one
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 2}, tangled), 6U);
  auto left = records(std::vector<double>(UntanglingPlan::kEnd + 3, -0.3));
  for (IterationRecord& record : left) record.statistics.inverted = 2;
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 2}, left), UntanglingPlan::kEnd + 1) << "none of them helped";
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 2}, left, 1, true), UntanglingPlan::kEnd) << "the next phase is the last attempt";
}

/// Small rises that add up count: a first phase alone would go on, too.
TEST(PhaseSwitchDetector, AddsUpSmallRises) {
  const auto slow = records({0.1, 0.1 + 4e-7, 0.1 + 8e-7, 0.1 + 12e-7, 0.1 + 16e-7, 0.1 + 20e-7, 0.1 + 20e-7, 0.1 + 20e-7});
  EXPECT_EQ(PhaseSwitchDetector().find({.patience = 3}, slow), 6U) << "the last rise of 1e-6 is in iteration 3";
}

RunParameters two_phases(std::uint64_t patience = 2) {
  RunParameters parameters;
  parameters.then_mean = PhaseBegin{.patience = patience};
  return parameters;
}

dmoscope::Run make_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters, std::size_t history = std::size_t{1} << 28U,
                       unsigned threads = 1) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(threads), history};
}

/// Takes the run well into its second phase.
std::uint64_t go_beyond(dmoscope::Run& run) {
  Progress progress;
  while (!run.mean_since() && run.moment().iteration < 300) run.iterate(1, progress);
  EXPECT_TRUE(run.mean_since());
  run.iterate(5, progress);
  return run.mean_since().value_or(0);
}

class MeanPhaseOf : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Meshes, MeanPhaseOf, ::testing::Values(Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed));

TEST_P(MeanPhaseOf, RaisesTheMeanAndKeepsTheMinimum) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    RunParameters parameters = two_phases();
    parameters.search.precision = precision;
    auto run = make_run(input(lattice(12, 0.3, 3, GetParam())), parameters);
    const std::uint64_t since = go_beyond(run);
    const auto& all = run.history().records();
    ASSERT_EQ(all[since].statistics.inverted, 0U);
    EXPECT_GT(all.back().statistics.mean, all[since].statistics.mean + 1e-4);
    for (std::size_t i = since + 1; i < all.size(); ++i) {
      EXPECT_GE(all[i].statistics.minimum, all[i - 1].statistics.minimum);
      EXPECT_GE(all[i].statistics.movable_minimum, all[i - 1].statistics.movable_minimum);
      EXPECT_GE(all[i].statistics.mean, all[i - 1].statistics.mean - 1e-15);
      EXPECT_EQ(all[i].statistics.inverted, 0U);
    }
  }
}

TEST_P(MeanPhaseOf, IsTheFirstPhaseBeforeItBegins) {
  const auto mesh = input(lattice(12, 0.3, 3, GetParam()));
  auto two = make_run(mesh, two_phases()), one = make_run(mesh, {});
  const std::uint64_t since = go_beyond(two);
  Progress progress;
  one.iterate(since, progress);
  two.seek({since - 1}, progress);
  one.seek({since - 1}, progress);
  EXPECT_TRUE(same_bits(one.positions(), two.positions()));
}

/// Meshes whose first phase goes beyond its best iteration.
class MeanPhaseAfterWear : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Meshes, MeanPhaseAfterWear, ::testing::Values(Cells::Triangles, Cells::Mixed));

/// The best of a first phase: the last of the iterations of greatest mean among those of greatest minimum.
std::uint64_t best_by_hand(std::span<const IterationRecord> all) {
  const auto worth = [](const IterationRecord& record) { return std::pair(record.statistics.movable_minimum, record.statistics.mean); };
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
    if (worth(all[i]) >= worth(all[best])) best = i;
  return best;
}

TEST_P(MeanPhaseAfterWear, BeginsWithTheBestStateOfTheFirst) {
  const auto mesh = input(lattice(14, 0.45, 8, GetParam()));
  auto two = make_run(mesh, two_phases(40)), one = make_run(mesh, {}), poor = make_run(mesh, two_phases(40), 0, 2);
  const std::uint64_t since = go_beyond(two);
  Progress progress;
  one.iterate(since, progress);
  const std::uint64_t best = best_by_hand(one.history().records());
  ASSERT_LT(best, since) << "else this test shows nothing";
  EXPECT_EQ(two.phases().mean_from, best);
  const Statistics there = one.history().records()[best].statistics, worn = one.history().records()[since].statistics;
  ASSERT_GT(there.mean, worn.mean);
  EXPECT_EQ(two.history().records()[since].statistics.mean, there.mean);
  EXPECT_EQ(two.history().records()[since].statistics.minimum, there.minimum);
  EXPECT_GE(two.history().records().back().statistics.minimum, there.minimum);
  EXPECT_GE(two.history().records().back().statistics.mean, there.mean);
  one.seek({best}, progress);
  two.seek({since}, progress);
  EXPECT_TRUE(same_bits(one.positions(), two.positions()));
  // Over the end of the first phase and back, with nothing kept, and with other threads.
  poor.iterate(since + 3, progress);
  two.seek({since + 3}, progress);
  EXPECT_TRUE(same_bits(poor.positions(), two.positions()));
  for (const Moment& moment : {Moment{since - 1}, {since}, {since + 1, 5}, {since - 1, 9}, {since + 3}}) poor.seek(moment, progress);
  EXPECT_TRUE(same_bits(poor.positions(), two.positions()));
  EXPECT_EQ(compute_statistics(mesh->quality_context(), poor.positions(), Metric::MeanRatio, poor.immovable(), nullptr).mean,
            poor.history().records()[since + 3].statistics.mean);
}

/// The run is read in the first phase, after its best iteration, whose positions are lost.
TEST_P(MeanPhaseAfterWear, BeginsWithTheSameStateAfterItWasRead) {
  const auto mesh = input(lattice(14, 0.45, 8, GetParam()));
  auto whole = make_run(mesh, two_phases(40)), read = make_run(mesh, two_phases(40), 0);
  const std::uint64_t since = go_beyond(whole), best = *whole.phases().mean_from;
  ASSERT_LT(best + 1, since - 1);
  Progress progress;
  whole.seek({since - 1}, progress);
  RunSnapshot point = whole.point();
  const std::vector<IterationRecord>& all = whole.history().records();
  point.records = SharedVector<IterationRecord>(
      std::make_shared<const std::vector<IterationRecord>>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(since)));
  read.adopt(point, whole.positions(), progress);
  ASSERT_FALSE(read.mean_since());
  read.iterate(4, progress);
  whole.seek({since + 3}, progress);
  EXPECT_EQ(read.phases().mean_from, best);
  EXPECT_TRUE(same_bits(read.positions(), whole.positions()));
}

TEST(MeanPhase, ACancelledWayToTheBestStateIsGoneAgain) {
  const auto mesh = input(lattice(12, 0.3, 3));
  auto whole = make_run(mesh, two_phases(40)), cancelled = make_run(mesh, two_phases(40), 0);
  const std::uint64_t since = go_beyond(whole);
  Progress progress;
  cancelled.iterate(since + 2, progress);
  cancelled.set_history_budget(0);  // releases kept positions
  bool was_there = false;
  cancelled.set_observer([&](const dmoscope::Run& run) {
    was_there = was_there || run.moment().iteration + 1 == since;
    if (was_there && run.moment().iteration < 3) progress.request_cancel();
  });
  EXPECT_THROW(cancelled.seek({since}, progress), Cancelled);
  ASSERT_TRUE(was_there);
  cancelled.set_observer({});
  progress.clear_cancel();
  cancelled.seek({since + 2}, progress);
  whole.seek({since + 2}, progress);
  EXPECT_TRUE(same_bits(cancelled.positions(), whole.positions()));
}

TEST_P(MeanPhaseOf, HasTheSameBitsWhicheverWayItIsReached) {
  const auto mesh = input(lattice(12, 0.3, 3, GetParam()));
  auto straight = make_run(mesh, two_phases());
  const std::uint64_t since = go_beyond(straight);
  const std::vector<Vec3> end(straight.positions().begin(), straight.positions().end());
  Progress progress;
  auto threaded = make_run(mesh, two_phases(), 0, 3), stepped = make_run(mesh, two_phases(), 0), sought = make_run(mesh, two_phases(), 0);
  threaded.iterate(since + 5, progress);
  EXPECT_TRUE(same_bits(threaded.positions(), end)) << "threads";
  while (stepped.moment().iteration < since + 5)
    stepped.step(stepped.moment().visits % 5 == 0 ? StepUnit::Vertex : StepUnit::Class, progress);
  EXPECT_TRUE(same_bits(stepped.positions(), end)) << "steps";
  // Back into the first phase and forth, and also from the middle of the second.
  for (const Moment& moment : {Moment{since + 5}, {since - 1, 7}, {since + 2, 11}, {since, 3}, {since + 5}}) sought.seek(moment, progress);
  EXPECT_TRUE(same_bits(sought.positions(), end)) << "seeks";
}

TEST(MeanPhase, ACancelledRunGoesOnWithTheSameBits) {
  const auto mesh = input(lattice(20, 0.3, 4));
  auto straight = make_run(mesh, two_phases()), cancelled = make_run(mesh, two_phases());
  const std::uint64_t since = go_beyond(straight);
  Progress progress;
  int blocks = 0;
  cancelled.set_observer([&](const dmoscope::Run& run) {
    if (run.moment().iteration > since && ++blocks == 2) progress.request_cancel();
  });
  EXPECT_THROW(cancelled.iterate(since + 5, progress), Cancelled);
  EXPECT_LT(cancelled.moment(), Moment{since + 5});
  progress.clear_cancel();
  cancelled.seek({since + 5}, progress);
  EXPECT_TRUE(same_bits(cancelled.positions(), straight.positions()));
}

/// Harmonic mean of all elements, which are sound.
double harmonic_mean(const dmoscope::Run& run) {
  std::vector<double> qualities(run.input().mesh.elements.size());
  element_qualities(run.input().quality_context(), run.positions(), run.parameters().metric, nullptr, qualities);
  double sum = 0.0;
  for (const double q : qualities) sum += 1.0 / q;
  return static_cast<double>(qualities.size()) / sum;
}

/// Nothing can untangle an element whose corners are all fixed: the mean of the others is raised.
TEST(MeanPhase, RaisesTheMeanOfTheRestWhereAnElementStaysInverted) {
  for (const bool joint : {false, true}) {
    Mesh mesh = lattice(12, 0.3, 3);
    mesh.positions.push_back({0.04, 0.02, 0});  // on the wrong side of the boundary edge that its element stands on
    testing::add(mesh, {1, 0, static_cast<Index>(mesh.positions.size() - 1)});
    RunParameters parameters = two_phases(20);
    if (joint) parameters.then_joint = PhaseBegin{.patience = 20};
    auto run = make_run(input(std::move(mesh)), parameters);
    Progress progress;
    const Outcome outcome = run.until_converged({.patience = 20, .max_iterations = 2000}, progress);
    ASSERT_TRUE(run.mean_since());
    const auto& all = run.history().records();
    const Statistics &begin = all[*run.mean_since()].statistics, &end = all[outcome.ended].statistics;
    EXPECT_EQ(begin.inverted, 1U);
    EXPECT_EQ(end.inverted, 1U);
    EXPECT_GE(end.minimum, begin.minimum);
    EXPECT_GT(end.mean, begin.mean + (joint ? 0.0 : 0.01));  // joint moves raise it themselves
    EXPECT_GT(outcome.iterations, *run.mean_since());
  }
}

TEST(MeanPhase, GoesOnWithATangledMesh) {
  auto run = make_run(input(lattice(9, 0.9, 42)), two_phases(1));
  Progress progress;
  for (int i = 0; i < 30; ++i) {
    const auto since = run.mean_since();
    const Statistics before = run.statistics();
    const double mean = harmonic_mean(run);
    run.iterate(1, progress);
    if (!since) continue;
    EXPECT_GE(run.statistics().minimum, before.minimum);
    EXPECT_GE(harmonic_mean(run), mean - 1e-15);
    EXPECT_LE(run.statistics().inverted, before.inverted);
  }
  EXPECT_TRUE(run.mean_since());
}

TEST(MeanPhase, UntilConvergedGoesThroughBoth) {
  auto run = make_run(input(lattice(10, 0.3, 5)), two_phases(3));
  Progress progress;
  const Outcome outcome = run.until_converged({.patience = 3}, progress);
  ASSERT_TRUE(outcome.phases.mean_since);
  EXPECT_NE(outcome.reason, StopReason::IterationLimit);
  EXPECT_GT(run.moment().iteration, *outcome.phases.mean_since);
  EXPECT_THAT(outcome.sentence(), HasSubstr("the mean was raised"));
  const auto& all = run.history().records();
  const double last_rise = all.back().statistics.mean - all[all.size() - 4].statistics.mean;
  EXPECT_TRUE(all.back().moved == 0 || last_rise < 1e-6) << "while it rises there is no end: " << last_rise;
}

/// Random directions never prove that nothing will move any more; the second phase looks in all directions.
TEST(MeanPhase, NothingMovesAnyMoreAlsoAfterDvr) {
  Mesh mesh;  // its only free vertex is in the middle already
  mesh.positions = {{1, 0, 0}, {0.5, 0.75, 0}, {-0.5, 0.75, 0}, {-1, 0, 0}, {-0.5, -0.75, 0}, {0.5, -0.75, 0}, {0, 0, 0}};
  for (Index i = 0; i < 6; ++i) testing::add(mesh, {i, (i + 1) % 6, 6});
  RunParameters parameters = two_phases(3);
  parameters.method = "dvr";
  auto run = make_run(input(std::move(mesh)), parameters);
  Progress progress;
  const Outcome outcome = run.until_converged({.patience = 3, .max_iterations = 90}, progress);
  EXPECT_EQ(outcome.reason, StopReason::NothingMoved);
  EXPECT_TRUE(outcome.phases.mean_since);
}

/// A session that is driven by commands.
struct Told {
  Session session{1};
  Progress progress;
  CommandContext context{session, progress, [](const Message&) {}};
  CommandTable commands;
  Told() { add_session_commands(commands, context); }
  void say(const std::string& line) { commands.execute(line); }
};

/// The phase's own patience does not matter: a run that converges gives up nothing that it would gain alone.
TEST(MeanPhase, UntilConvergedDoesNotBeginItBeforeTheFirstHasConverged) {
  Told alone, hasty, patient;
  for (Told* told : {&alone, &hasty, &patient}) told->say("generate random 400");
  alone.say("until-converged best 60");
  const Statistics best = alone.session.active().statistics();
  hasty.say("then arithmetic-mean 1");
  hasty.say("run 150");
  ASSERT_LT(hasty.session.active().statistics().minimum, best.minimum - 0.01) << "else this test shows nothing";
  patient.say("then arithmetic-mean 1");
  patient.say("until-converged 60");
  const dmoscope::Run& run = patient.session.active();
  ASSERT_TRUE(run.mean_since());
  EXPECT_GE(*run.mean_since(), alone.session.active().last_outcome()->last_rise + 60);
  EXPECT_GE(run.statistics().minimum, best.minimum);
  EXPECT_GE(run.statistics().mean, best.mean);
  // Once it has begun its start stays.
  const std::uint64_t since = *run.mean_since();
  patient.say("until-converged 100");
  EXPECT_EQ(run.mean_since(), since);
}

TEST(MeanPhase, IsUndoneAndSaved) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "session.json").string();
  Told told;
  told.say("generate random 300 7");
  told.say("then mean 2");
  EXPECT_THAT(told.session.active().title(), HasSubstr("then mean"));
  told.say("until-converged 2");
  ASSERT_TRUE(told.session.active().mean_since());
  const std::vector<Vec3> end(told.session.active().positions().begin(), told.session.active().positions().end());
  told.say("back iteration 2");
  told.say("undo");
  EXPECT_TRUE(same_bits(told.session.active().positions(), end));
  told.say("save-state " + file);
  Told other;
  other.say("open-state " + file);
  EXPECT_EQ(other.session.active().parameters(), told.session.active().parameters());
  EXPECT_EQ(other.session.active().mean_since(), told.session.active().mean_since());
  EXPECT_EQ(other.session.active().phases().mean_from, told.session.active().phases().mean_from);
  ASSERT_TRUE(told.session.active().phases().mean_from) << "else this test shows less";
  EXPECT_TRUE(same_bits(other.session.active().positions(), end));
  // A run saved in the second phase has no positions of the first: they are computed again, and the start with them.
  const std::uint64_t since = *told.session.active().mean_since();
  for (const std::uint64_t iteration : {since, since - 1, since + 1}) {
    for (Told* one : {&told, &other}) one->say(fmt::format("seek {}", iteration));
    EXPECT_TRUE(same_bits(told.session.active().positions(), other.session.active().positions())) << iteration;
  }
  for (Told* one : {&told, &other}) one->say("undo");  // undoes all three seeks, which count as one
  EXPECT_TRUE(same_bits(told.session.active().positions(), end));
  for (Told* one : {&told, &other}) one->say(fmt::format("seek {}", since - 1));
  for (Told* one : {&told, &other}) one->say("run 2");
  EXPECT_TRUE(same_bits(told.session.active().positions(), other.session.active().positions()));
  other.say("undo");
  other.say("then nothing");
  EXPECT_FALSE(other.session.active().parameters().then_mean);
}

TEST(CompositeTerms, IsSaidAndSaved) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "session.json").string();
  Told told;
  told.say("generate random 300 7");
  EXPECT_THROW(told.say("size-point 1 2"), UsageError);
  told.say("combine mean-ratio:0.4:density h1:0.5,0.5");
  told.say("size-point 0.25 0.75");
  told.say("run 3");
  const RunParameters& parameters = told.session.active().parameters();
  ASSERT_TRUE(parameters.combination);
  EXPECT_EQ(parameters.combination->size()->point, (Vec3{0.25, 0.75, 0.0}));
  told.say("save-state " + file);
  Told other;
  other.say("open-state " + file);
  EXPECT_EQ(other.session.active().parameters(), parameters);
  EXPECT_TRUE(same_bits(other.session.active().positions(), told.session.active().positions()));
  EXPECT_THROW(told.say("then mean"), UsageError);
  EXPECT_THROW(told.say("combine mean-ratio:0.7:density field:depth"), UsageError);
  EXPECT_TRUE(same_bits(other.session.active().positions(), told.session.active().positions())) << "nothing is half done";
  told.say("combine off");
  EXPECT_FALSE(told.session.active().parameters().combination);
}

}  // namespace
}  // namespace dmoscope
