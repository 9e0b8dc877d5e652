// The phase of joint moves: its start and end, its promises, and stepping, undoing, cancelling and saving like in any other.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/reference/domain.h"
#include "core/run/run.h"
#include "core/session/session.h"
#include "core/session/state_file.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::input;
using testing::lattice;

constexpr std::size_t kAmple = std::size_t{1} << 28U;

RunParameters then_joint(bool mean = false) {
  RunParameters parameters;
  parameters.then_joint = PhaseBegin{.patience = 5};
  if (mean) parameters.then_mean = parameters.then_joint;
  return parameters;
}

dmoscope::Run joint_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters, std::size_t history = kAmple) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(1), history};
}

std::vector<Vec3> copy_of(const dmoscope::Run& run) { return {run.positions().begin(), run.positions().end()}; }

class JointPhaseOf : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Meshes, JointPhaseOf, ::testing::Values(Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed));

TEST_P(JointPhaseOf, RaisesTheMinimumThatVisitsLeft) {
  const auto mesh = input(lattice(12, 0.35, 21, GetParam()));
  Progress progress;
  auto run = joint_run(mesh, then_joint());
  const Outcome outcome = run.until_converged({.patience = 5}, progress);
  const RunPhases phases = run.phases();
  ASSERT_TRUE(phases.joint_since && phases.joint_over);
  EXPECT_TRUE(outcome.reason == StopReason::Certified || outcome.reason == StopReason::NoJointGain) << outcome.sentence();
  const auto& records = run.history().records();
  EXPECT_GT(records.back().statistics.movable_minimum, records[*phases.joint_since].statistics.movable_minimum + 1e-4);
  for (std::size_t i = *phases.joint_since + 1; i < records.size(); ++i) {
    EXPECT_GE(records[i].statistics.minimum, records[i - 1].statistics.minimum) << i;
    ASSERT_TRUE(records[i].joint) << i;
    EXPECT_EQ(phases.of(i), Phase::Joint);
  }
  EXPECT_EQ(phases.of(*phases.joint_since), Phase::Method);
  EXPECT_EQ(records.back().moved, 0U);
}

TEST_P(JointPhaseOf, NoChainOfPhasesEndsBelowTheFirstAlone) {
  for (const std::uint64_t seed : {3U, 4U, 5U}) {
    const auto mesh = input(lattice(10, 0.4, seed, GetParam()));
    Progress progress;
    auto minimum = [&](RunParameters parameters) {
      auto run = joint_run(mesh, std::move(parameters));
      (void)run.until_converged({.patience = 10}, progress);
      run.end_at_best(progress);
      return run.statistics().movable_minimum;
    };
    RunParameters mean;
    mean.then_mean = PhaseBegin{};
    const double alone = minimum({}), joint = minimum(then_joint());
    EXPECT_GE(minimum(mean), alone - 1e-6) << seed;
    // A first phase alone raises the worst element of a tangled mesh jointly, too; the possible minimum is found within a gap.
    EXPECT_GE(joint, alone * (1.0 - RunParameters{}.joint_gap)) << seed;
    // The mean of the next phase may have the gap.
    EXPECT_GE(minimum(then_joint(true)), joint * (1.0 - RunParameters{}.joint_gap)) << seed;
  }
}

TEST_P(JointPhaseOf, HasTheSameBitsWhicheverWayItIsReached) {
  const auto mesh = input(lattice(12, 0.35, 21, GetParam()));
  Progress progress;
  auto straight = joint_run(mesh, then_joint(true));
  (void)straight.until_converged({.patience = 5}, progress);
  const RunPhases phases = straight.phases();
  ASSERT_TRUE(phases.joint_since && phases.mean_since);
  const std::uint64_t end = straight.moment().iteration;
  const auto expect_same = [&](dmoscope::Run& other, const Moment& moment, const char* how) {
    other.seek(moment, progress);
    straight.seek(moment, progress);
    EXPECT_TRUE(same_bits(other.positions(), straight.positions())) << how << ' ' << moment.iteration;
  };
  RunParameters same = then_joint(true);
  same.then_joint = same.then_mean = straight.parameters().then_joint;
  auto forgetful = joint_run(mesh, same, 0);
  for (const std::uint64_t iteration :
       {end, *phases.joint_since, *phases.joint_since + 1, *phases.mean_since, *phases.joint_since - 1, *phases.mean_since - 1, end})
    expect_same(forgetful, {iteration}, "seek");
  auto stepped = joint_run(mesh, same);
  while (stepped.moment().iteration < *phases.mean_since) stepped.step(StepUnit::Class, progress);
  expect_same(stepped, {*phases.mean_since}, "steps");
  for (std::uint64_t i = *phases.mean_since; i-- > *phases.joint_since;) {
    ASSERT_TRUE(stepped.back(StepUnit::Vertex, progress));
    EXPECT_EQ(stepped.moment(), Moment{i});
    expect_same(stepped, {i}, "back");
  }
}

/// Does some iterations of joint moves, saves and opens the run: `beyond`: once the second of two aims is raised.
void expect_the_same_after_it_was_saved(const RunParameters& parameters, bool beyond) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "session.json").string();
  Progress progress;
  Session session(1), other(1);
  session.generate("random 400 7", progress);
  (void)session.change(parameters);
  dmoscope::Run& run = session.active();
  const auto is_there = [&] {
    const auto& last = run.history().records().back();
    return run.joint_since() && run.moment().iteration >= *run.joint_since() + 2 && last.joint->beyond == beyond;
  };
  while (!is_there()) {
    ASSERT_LT(run.moment().iteration, 200U);
    run.iterate(1, progress);
  }
  save_state(file, session, {}, progress);
  (void)open_state(file, other, progress, session.input());
  EXPECT_EQ(other.active().parameters(), run.parameters());
  EXPECT_TRUE(same_bits(other.active().positions(), run.positions()));
  for (dmoscope::Run* one : {&run, &other.active()}) one->iterate(4, progress);
  EXPECT_TRUE(same_bits(other.active().positions(), run.positions()));
  for (const std::uint64_t iteration : {*run.joint_since() + 1, *run.joint_since(), *run.joint_since() + 3}) {
    for (dmoscope::Run* one : {&run, &other.active()}) one->seek({iteration}, progress);
    EXPECT_TRUE(same_bits(other.active().positions(), run.positions())) << iteration;
  }
}

TEST(JointPhase, GoesOnWithTheSameBitsAfterItWasSaved) {
  expect_the_same_after_it_was_saved(then_joint(), false);
  RunParameters both = then_joint();
  both.combination = CompositeTerms{0.3, Metric::MinAngle};
  expect_the_same_after_it_was_saved(both, true);
}

TEST(JointPhase, ACancelledClusterIsAsIfItHadNotBegun) {
  const auto mesh = input(lattice(12, 0.35, 21));
  Progress progress;
  auto whole = joint_run(mesh, then_joint()), cancelled = joint_run(mesh, then_joint());
  (void)whole.until_converged({.patience = 5}, progress);
  const std::uint64_t since = *whole.phases().joint_since;
  cancelled.seek({since}, progress);
  const std::vector<Vec3> before = copy_of(cancelled);
  int steps = 0;
  cancelled.set_observer([&](const dmoscope::Run&) {
    if (++steps == 3) progress.request_cancel();
  });
  EXPECT_THROW((void)cancelled.step(StepUnit::Iteration, progress), Cancelled);
  cancelled.set_observer({});
  progress.clear_cancel();
  EXPECT_EQ(cancelled.moment(), Moment{since});
  EXPECT_TRUE(same_bits(cancelled.positions(), before));
  cancelled.iterate(2, progress);
  whole.seek({since + 2}, progress);
  EXPECT_TRUE(same_bits(cancelled.positions(), whole.positions()));
}

TEST(JointPhase, VisitsOfChosenVerticesBeginItAnewAndAreUndone) {
  const auto mesh = input(lattice(12, 0.35, 21));
  Progress progress;
  auto run = joint_run(mesh, then_joint());
  (void)run.until_converged({.patience = 5}, progress);
  const std::uint64_t since = *run.phases().joint_since;
  const std::vector<Vec3> end = copy_of(run);
  const RunSnapshot there = run.point();
  run.seek({since + 1}, progress);
  const double minimum = run.statistics().minimum;
  (void)run.visit_vertices(std::vector<Index>{60, 61, 70}, progress);
  EXPECT_EQ(run.history().records().size(), since + 2);
  run.iterate(3, progress);
  EXPECT_GE(run.statistics().minimum, minimum);
  const std::vector<Vec3> edited = copy_of(run);
  const Moment moment = run.moment();
  run.seek({since, 0}, progress);
  run.seek(moment, progress);
  EXPECT_TRUE(same_bits(run.positions(), edited));
  run.go_to(there, progress);
  EXPECT_TRUE(same_bits(run.positions(), end));
  run.seek({since + 1}, progress);
  run.seek(there.moment, progress);
  EXPECT_TRUE(same_bits(run.positions(), end));
}

TEST(JointPhase, SlidingVerticesMoveAlongTheirSides) {
  const auto mesh = input(lattice(12, 0.35, 21));
  Progress progress;
  RunParameters parameters = then_joint();
  parameters.boundary = BoundaryRule::Slide;
  auto run = joint_run(mesh, parameters);
  (void)run.until_converged({.patience = 5}, progress);
  const std::vector<Vec3> end = copy_of(run);
  run.seek({*run.phases().joint_since}, progress);
  std::size_t sliding = 0, moved = 0;
  for (Index v = 0; v < end.size(); ++v) {
    if (!run.domain()->slides(v)) continue;
    const Vec3 before = mesh->mesh.positions[v];
    ++sliding;
    moved += same_bits(std::span(end).subspan(v, 1), run.positions().subspan(v, 1)) ? 0 : 1;
    EXPECT_TRUE(before.x == 0.0 || before.x == 1.0 ? end[v].x == before.x : end[v].y == before.y) << v;
  }
  EXPECT_GT(sliding, 30U);
  EXPECT_GT(moved, 10U);
}

TEST(JointPhase, WhereNothingIsFreeItIsOverAtOnce) {
  const auto mesh = input(lattice(1, 0.0, 1));
  Progress progress;
  for (const RunParameters& parameters : {then_joint(), then_joint(true), RunParameters{.method = "joint"}}) {
    auto run = joint_run(mesh, parameters);
    EXPECT_LE(run.until_converged({}, progress).iterations, 6U);
  }
}

TEST(JointPhase, IsRefusedInWords) {
  const auto mesh = input(lattice(4, 0.1, 1));
  RunParameters twice = then_joint(), kinked = then_joint();
  twice.method = "joint";
  EXPECT_THROW(joint_run(mesh, twice), UsageError);
  kinked.metric = Metric::Rectangularity;
  EXPECT_THROW(joint_run(mesh, kinked), UsageError);
}

}  // namespace
}  // namespace dmoscope
