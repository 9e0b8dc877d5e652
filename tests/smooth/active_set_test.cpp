// Sleeping vertices would have stayed: smoothing that visits only the vertices whose stars changed gives the bits of smoothing that visits
// all.

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "core/smooth/execution/method_table.h"
#include "tests/smooth/zoo.h"

namespace dmoscope {
namespace {

constexpr std::uint64_t kMostIterations = 30;

dmoscope::Run active_set_run(const testing::Specimen& specimen, const std::shared_ptr<const InputMesh>& mesh, Metric metric) {
  RunParameters parameters;
  parameters.metric = metric;
  parameters.search = specimen.search;
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(1), std::size_t{1} << 28U};
}

/// Visits every vertex, all awake.
void visit_all(Smoother& smoother, const Colouring& colouring, std::vector<Vec3>& positions) {
  for (Index c = 0; c < colouring.class_count(); ++c) {
    const std::uint64_t first = colouring.class_offsets[c], count = colouring.class_offsets[c + 1] - first;
    smoother.positions_replaced();
    smoother.visit(first, count, positions, nullptr);
    smoother.store(positions, nullptr);
  }
}

/// Positions after each iteration of a run that wakes all vertices before every visit.
std::vector<std::vector<Vec3>> always_awake(const dmoscope::Run& run) {
  const auto mesh = std::shared_ptr<const InputMesh>(std::shared_ptr<void>(), &run.input());
  const auto colouring = std::make_shared<const Colouring>(run.colouring());
  SmoothingTask task{.input = mesh, .colouring = colouring, .metric = run.parameters().metric, .search = run.parameters().search};
  task.guard = run.guard();
  const auto smoother = make_smoother(task);
  std::vector<std::vector<Vec3>> after{run.input().mesh.positions};
  std::vector<Vec3> positions = after[0];
  std::vector<IterationRecord> records{run.history().records()[0]};
  for (std::uint64_t iteration = 0; iteration < kMostIterations; ++iteration) {
    std::uint64_t moved = 0;
    if (!mesh->is_surface() && untangles_jointly(records, iteration, mesh->has_strays)) {
      dmoscope::Run other(mesh, run.parameters(), std::make_shared<ThreadPool>(1), 0);
      Progress progress;
      other.iterate(iteration + 1, progress);
      moved = other.history().records().back().moved;
      positions.assign(other.positions().begin(), other.positions().end());
    } else {
      smoother->begin(sweep_after(records, iteration, {}, mesh->has_strays));
      visit_all(*smoother, *colouring, positions);
    }
    after.push_back(positions);
    const Statistics now = compute_statistics(mesh->quality_context(), positions, run.parameters().metric, run.immovable(), nullptr);
    records.push_back({iteration + 1, now, moved, 0.0});
  }
  return after;
}

class ActiveSet : public ::testing::TestWithParam<Metric> {};

TEST_P(ActiveSet, IsExact) {
  Progress progress;
  for (const testing::Specimen& specimen : testing::zoo()) {
    if (!testing::defined_for_all(GetParam(), specimen.mesh)) continue;
    const auto mesh = testing::input(specimen.mesh);
    dmoscope::Run run = active_set_run(specimen, mesh, GetParam());
    const auto expected = always_awake(run);
    run.iterate(kMostIterations, progress, [&](const dmoscope::Run& now) {
      EXPECT_TRUE(same_bits(now.positions(), expected[now.moment().iteration])) << specimen.name << ", " << now.moment().iteration;
    });
  }
}

TEST_P(ActiveSet, IsExactAfterStepsBackAndForth) {
  Progress progress;
  for (const testing::Specimen& specimen : testing::zoo()) {
    if (!testing::defined_for_all(GetParam(), specimen.mesh)) continue;
    const auto mesh = testing::input(specimen.mesh);
    dmoscope::Run run = active_set_run(specimen, mesh, GetParam());
    const auto expected = always_awake(run);
    run.iterate(9, progress);
    const std::uint64_t half = run.visits_per_iteration() / 2;
    for (const Moment target : {Moment{3, half}, Moment{12, 1}, Moment{11, half}, Moment{0, 1}, Moment{20, 0}}) {
      run.seek(target, progress);
      for (const StepUnit unit : {StepUnit::Vertex, StepUnit::Class, StepUnit::Iteration, StepUnit::Vertex}) {
        run.back(unit, progress);
        run.step(StepUnit::Vertex, progress);
      }
      run.step(StepUnit::Iteration, progress);  // to the end of this iteration
      EXPECT_TRUE(same_bits(run.positions(), expected[run.moment().iteration])) << specimen.name << ", " << run.moment().iteration;
    }
    run.seek({kMostIterations, 0}, progress);
    EXPECT_TRUE(same_bits(run.positions(), expected[kMostIterations])) << specimen.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, ActiveSet, ::testing::Values(Metric::MeanRatio, Metric::MeanRatioArea, Metric::Rectangularity));

}  // namespace
}  // namespace dmoscope
