// Runs: stepping forwards and back, history within its budget, stopping.

#include "core/run/run.h"

#include <cstring>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::input;
using testing::lattice;

std::vector<Vec3> positions_of(const dmoscope::Run& run) { return {run.positions().begin(), run.positions().end()}; }
dmoscope::Run lattice_run(std::size_t budget = std::size_t{1} << 28U, Index n = 16) {
  return {input(lattice(n, 0.3, 31)), {}, std::make_shared<ThreadPool>(2), budget};
}

TEST(Run, BackUndoesEveryKindOfStepBitForBit) {
  Progress progress;
  dmoscope::Run run = lattice_run();
  run.iterate(2, progress);
  for (const StepUnit unit : {StepUnit::Vertex, StepUnit::Class, StepUnit::Iteration}) {
    std::vector<std::vector<Vec3>> trail{positions_of(run)};
    const Moment start = run.moment();
    const int steps = unit == StepUnit::Vertex ? 300 : 9;  // more than one iteration's vertices (15 * 15)
    for (int i = 0; i < steps; ++i) {
      run.step(unit, progress);
      trail.push_back(positions_of(run));
    }
    for (int i = steps; i-- > 0;) {
      EXPECT_TRUE(run.back(unit, progress));
      EXPECT_TRUE(same_bits(positions_of(run), trail[static_cast<std::size_t>(i)])) << static_cast<int>(unit) << " " << i;
    }
    EXPECT_EQ(run.moment(), start);
  }
}

TEST(Run, BackFromTheMidstGoesToTheStartOfWhatIsUnderWay) {
  Progress progress;
  dmoscope::Run run = lattice_run();
  run.step(StepUnit::Class, progress);
  const Moment class_start = run.moment();
  run.step(StepUnit::Vertex, progress);
  run.step(StepUnit::Vertex, progress);
  run.back(StepUnit::Class, progress);
  EXPECT_EQ(run.moment(), class_start);
  run.step(StepUnit::Vertex, progress);
  run.back(StepUnit::Iteration, progress);
  EXPECT_EQ(run.moment(), Moment{});
  EXPECT_FALSE(run.back(StepUnit::Vertex, progress));
}

TEST(Run, StepReportsWhatMovedAndIterationsRecordTheSum) {
  Progress progress;
  dmoscope::Run run = lattice_run();
  std::uint64_t moved = 0;
  while (run.moment().iteration == 0) {
    const auto before = positions_of(run);
    const std::uint64_t reported = run.step(StepUnit::Vertex, progress);
    EXPECT_EQ(reported, same_bits(before, positions_of(run)) ? 0U : 1U);
    moved += reported;
  }
  EXPECT_EQ(run.history().records()[1].moved, moved);
  EXPECT_GT(moved, 0U);
}

TEST(History, KeepsWithinItsBudgetAndStillReachesEveryIteration) {
  Progress progress;
  dmoscope::Run rich = lattice_run();
  std::vector<std::vector<Vec3>> states{positions_of(rich)};
  rich.iterate(20, progress, [&](const dmoscope::Run& run) { states.push_back(positions_of(run)); });
  EXPECT_TRUE(rich.history().sentence().empty());

  const std::size_t budget = 5 * 17 * 17 * sizeof(Vec3);
  dmoscope::Run poor = lattice_run(budget);
  poor.iterate(20, progress);
  EXPECT_LE(poor.history().bytes(), budget);
  EXPECT_FALSE(poor.history().sentence().empty()) << "the budget was met: it must be said";
  EXPECT_EQ(poor.history().records().size(), 21U) << "statistics of every iteration are kept";
  for (const std::uint64_t iteration : {13U, 7U, 19U, 0U, 20U, 1U}) {
    poor.seek({iteration, 0}, progress);
    EXPECT_TRUE(same_bits(positions_of(poor), states[iteration])) << iteration;
  }
}

TEST(History, WithoutABudgetOnlyTheInputItselfIsKept) {
  Progress progress;
  dmoscope::Run run = lattice_run(0);
  EXPECT_TRUE(run.history().sentence().empty());
  std::vector<std::vector<Vec3>> states{positions_of(run)};
  run.iterate(5, progress, [&](const dmoscope::Run& now) { states.push_back(positions_of(now)); });
  EXPECT_EQ(run.history().bytes(), 0U);
  EXPECT_EQ(run.history().nearest(5).iteration, 0U);
  EXPECT_EQ(run.history().nearest(5).positions.data(), run.input().mesh.positions.data()) << "shared, not copied";
  EXPECT_FALSE(run.history().sentence().empty());
  for (const std::uint64_t iteration : {4U, 0U, 2U, 5U}) {
    run.seek({iteration, 0}, progress);
    EXPECT_TRUE(same_bits(positions_of(run), states[iteration])) << iteration;
  }
}

TEST(Run, StatisticsAreThoseOfTheMomentWhereverItStands) {
  Progress progress;
  dmoscope::Run run = lattice_run();
  const auto expect_right = [&] {
    const Statistics now = run.statistics();
    const Statistics fresh = compute_statistics(run.input().quality_context(), run.positions(), Metric::MeanRatio, run.fixed(), nullptr);
    EXPECT_EQ(now.minimum, fresh.minimum);
    EXPECT_EQ(now.mean, fresh.mean);
    EXPECT_EQ(now.movable_minimum, fresh.movable_minimum);
    EXPECT_EQ(now.ceiling, fresh.ceiling);
    EXPECT_EQ(now.worst_element, fresh.worst_element);
  };
  expect_right();
  run.iterate(3, progress);
  expect_right();
  run.step(StepUnit::Class, progress);
  expect_right();
  run.back(StepUnit::Vertex, progress);
  expect_right();
  run.seek({1, 0}, progress);
  expect_right();
}

TEST(Run, UntilConvergedSaysWhyItStopped) {
  Progress progress;
  dmoscope::Run run = lattice_run();
  const Outcome outcome = run.until_converged({.patience = 30, .max_iterations = 5000, .rise = 1e-6}, progress);
  EXPECT_NE(outcome.reason, StopReason::IterationLimit);
  EXPECT_GT(outcome.last_rise, 0U);
  const auto& records = run.history().records();
  EXPECT_EQ(records.size(), outcome.iterations + 1);
  if (outcome.reason == StopReason::NothingMoved) {
    EXPECT_EQ(records.back().moved, 0U);
  } else {
    EXPECT_EQ(outcome.iterations, outcome.last_rise + 30);
  }
  for (std::size_t i = outcome.last_rise + 1; i < records.size(); ++i) {
    EXPECT_LT(records[i].statistics.minimum, records[outcome.last_rise].statistics.minimum + 1e-6);
  }
  EXPECT_TRUE(run.last_outcome().has_value());
  dmoscope::Run limited = lattice_run();
  EXPECT_EQ(limited.until_converged({.max_iterations = 1}, progress).reason, StopReason::IterationLimit);
}

TEST(Run, AMeshWithNothingFreeConvergesAtOnce) {
  Mesh mesh;
  mesh.name = "one";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  testing::add(mesh, {0, 1, 2});
  dmoscope::Run run(input(std::move(mesh)), {}, std::make_shared<ThreadPool>(1), 1U << 20U);
  Progress progress;
  const Outcome outcome = run.until_converged({}, progress);
  EXPECT_EQ(outcome.reason, StopReason::NothingMoved);
  EXPECT_EQ(outcome.iterations, 1U);
  EXPECT_EQ(outcome.last_rise, 0U);
  run.step(StepUnit::Vertex, progress);
  EXPECT_TRUE(run.back(StepUnit::Vertex, progress));
}

TEST(Run, CancelLeavesAnExactMoment) {
  Progress progress;
  dmoscope::Run run = lattice_run(std::size_t{1} << 28U, 200);  // several blocks an iteration
  int blocks = 0;
  run.set_observer([&](const dmoscope::Run&) {
    if (++blocks == 2) progress.request_cancel();
  });
  EXPECT_THROW(run.iterate(10, progress), Cancelled);
  const Moment stopped = run.moment();
  const auto at_cancel = positions_of(run);
  progress.clear_cancel();
  run.set_observer({});
  dmoscope::Run other = lattice_run(std::size_t{1} << 28U, 200);
  other.seek(stopped, progress);
  EXPECT_TRUE(same_bits(positions_of(other), at_cancel));
}

TEST(Run, WrongParametersAreRefused) {
  const auto mesh = input(lattice(4, 0.1, 1, testing::Cells::Quadrilaterals));
  const auto pool = std::make_shared<ThreadPool>(1);
  EXPECT_THROW(dmoscope::Run(mesh, {.method = "nonsense"}, pool, 0), UsageError);
  EXPECT_THROW(dmoscope::Run(mesh, {.metric = Metric::MinAngle}, pool, 0), UsageError);
  EXPECT_THROW(dmoscope::Run(mesh, {.search = {.grid_points = 1}}, pool, 0), UsageError);
  EXPECT_THROW(dmoscope::Run(mesh, {.fixed = {1000}}, pool, 0), UsageError);
}

}  // namespace
}  // namespace dmoscope
