// A run until it has converged on a tangled mesh: if single vertices are stuck those around the worst element move together.

#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/mesh/generate.h"
#include "core/run/run.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {
namespace raise_of_worst {

std::shared_ptr<const InputMesh> tangled(const char* name = "tangled-solids", std::size_t size = 150) {
  Progress unwatched;
  return testing::input(generate_mesh(name, size, 1, unwatched));
}
dmoscope::Run make_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters = {}, std::size_t history = 0) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(2), history};
}
std::vector<Vec3> copy_of(const dmoscope::Run& run) { return {run.positions().begin(), run.positions().end()}; }
std::vector<std::uint64_t> raises(const dmoscope::Run& run) {
  std::vector<std::uint64_t> all;
  for (const IterationRecord& record : run.history().records())
    if (record.joint) all.push_back(record.iteration);
  return all;
}

TEST(RaiseOfWorst, ReachesWhatThePhaseOfJointMovesReaches) {
  Progress progress;
  for (const auto& mesh : {tangled(), tangled("tangled", 300)}) {
    dmoscope::Run alone = make_run(mesh), jointly = make_run(mesh, {.then_joint = PhaseBegin{}}), single = make_run(mesh);
    const Outcome outcome = alone.until_converged({}, progress);
    EXPECT_GE(outcome.raised, 1U);
    EXPECT_EQ(outcome.reason, StopReason::Certified) << outcome.sentence();
    (void)jointly.until_converged({}, progress);
    single.iterate(outcome.iterations, progress);
    const double reached = alone.statistics().minimum;
    EXPECT_GT(reached, jointly.statistics().minimum * (1.0 - 3e-3));
    EXPECT_GT(reached, single.statistics().minimum + 2e-3);
    const auto& records = alone.history().records();
    for (std::size_t i = 1; i < records.size(); ++i) {
      EXPECT_GE(records[i].statistics.minimum, records[i - 1].statistics.minimum) << i;
      EXPECT_LE(records[i].statistics.inverted, records[i - 1].statistics.inverted) << i;
    }
  }
}

/// The mean is raised from the state in which the method's phase alone ends.
TEST(RaiseOfWorst, ComesBeforeTheMeanIsRaised) {
  Progress progress;
  for (const auto& mesh : {tangled(), tangled("tangled", 300)}) {
    RunParameters parameters;
    parameters.then_mean = PhaseBegin{};
    dmoscope::Run alone = make_run(mesh), mean = make_run(mesh, parameters);
    const Outcome outcome = mean.until_converged({}, progress);
    (void)alone.until_converged({}, progress);
    EXPECT_EQ(raises(mean), raises(alone));
    EXPECT_EQ(outcome.raised, raises(mean).size());
    ASSERT_TRUE(outcome.phases.mean_since);
    EXPECT_GT(*outcome.phases.mean_since, raises(mean).back());
    EXPECT_GE(mean.statistics().minimum, alone.statistics().minimum);
  }
}

TEST(RaiseOfWorst, IsAnIterationLikeAnyOther) {
  const auto mesh = tangled();
  Progress progress;
  dmoscope::Run run = make_run(mesh), single = make_run(mesh);
  (void)run.until_converged({}, progress);
  const std::vector<Vec3> end = copy_of(run);
  const Moment last = run.moment();
  const std::uint64_t raise = raises(run).at(0);
  run.seek({raise - 1}, progress);
  single.iterate(raise - 1, progress);
  EXPECT_TRUE(same_bits(run.positions(), single.positions())) << "before it the run is that by iterations";
  EXPECT_GT(run.step(StepUnit::Vertex, progress), 1U) << "it is one step, whatever the unit";
  EXPECT_EQ(run.moment(), (Moment{raise}));
  EXPECT_TRUE(run.back(StepUnit::Class, progress));
  EXPECT_EQ(run.moment(), (Moment{raise - 1}));
  run.seek(last, progress);
  EXPECT_TRUE(same_bits(run.positions(), end));
  single.iterate(10, progress);
  EXPECT_TRUE(raises(single).empty()) << "iterations that were counted out have none";
}

/// Runs saved before it, and after it.
TEST(RaiseOfWorst, IsTheSameOfARunThatWasSavedOnItsWay) {
  const auto mesh = tangled();
  Progress progress;
  for (const bool then_mean : {false, true}) {
    RunParameters parameters;
    if (then_mean) parameters.then_mean = PhaseBegin{};
    dmoscope::Run whole = make_run(mesh, parameters);
    const Outcome outcome = whole.until_converged({}, progress);
    const std::vector<Vec3> end = copy_of(whole);
    const std::uint64_t raise = raises(whole).at(0);
    for (const std::uint64_t at : {raise - 1, raise, raise + 3}) {
      whole.seek({at}, progress);
      RunSnapshot point = whole.point();
      std::vector<IterationRecord> records = point.records.whole();
      records.resize(at + 1);
      point.records = SharedVector<IterationRecord>(std::make_shared<const std::vector<IterationRecord>>(std::move(records)));
      dmoscope::Run again = make_run(mesh, parameters);
      again.adopt(point, whole.positions(), progress);
      EXPECT_EQ(again.until_converged_from_input({}, progress).sentence(), outcome.sentence()) << at;
      EXPECT_TRUE(same_bits(again.positions(), end)) << at;
    }
  }
}

TEST(RaiseOfWorst, IsForWhatCameTangledAlone) {
  Progress progress;
  for (const auto& mesh :
       {testing::input(testing::lattice(8, 0.3, 5)), testing::input(testing::lattice(5, 0.3, 6, testing::Cells::Mixed))}) {
    ASSERT_TRUE(mesh->report.inverted_elements.empty());
    dmoscope::Run run = make_run(mesh), single = make_run(mesh);
    const Outcome outcome = run.until_converged({}, progress);
    EXPECT_EQ(outcome.raised, 0U);
    single.iterate(outcome.iterations, progress);
    EXPECT_TRUE(same_bits(run.positions(), single.positions()));
  }
}

/// A corner between three fixed vertices is the worst, and nothing changes that: what joint moves make of the others does not count.
TEST(RaiseOfWorst, LeavesTheOthersWhereFixedVerticesHoldTheWorstForGood) {
  Progress progress;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    constexpr Index kRow = 11;
    Mesh mesh = testing::lattice(kRow - 1, 0.3, seed, testing::Cells::Quadrilaterals);
    const double width = 1.0 / (kRow - 1), height = 0.1 * width;
    mesh.positions[kRow].y = height;
    std::swap(mesh.positions[5 * kRow + 5], mesh.positions[5 * kRow + 6]);
    const auto tangled = testing::input(std::move(mesh));
    ASSERT_FALSE(tangled->report.inverted_elements.empty());
    dmoscope::Run run = make_run(tangled);
    const Outcome outcome = run.until_converged({}, progress);
    EXPECT_EQ(outcome.reason, StopReason::Certified) << outcome.sentence();
    EXPECT_TRUE(raises(run).empty()) << outcome.sentence();
    const double of_corner = 2.0 * width * height / (width * width + height * height);
    EXPECT_NEAR(run.statistics().minimum, of_corner, 1e-12);
  }
}

}  // namespace raise_of_worst
}  // namespace
}  // namespace dmoscope
