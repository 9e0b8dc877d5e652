// Traces of visits that have two aims: they show the smoother's result, bit for bit, and values of its objective.

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/inspect/visit_trace.h"
#include "core/run/run.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;

/// The least and the mean of a metric over the star of `vertex`, standing at `place`.
std::pair<double, double> star_at(const InputMesh& input, std::vector<Vec3> positions, Metric metric, Index vertex, Vec3 place) {
  positions[vertex] = place;
  double least = INFINITY, sum = 0.0;
  for (const Incidence& at : input.topology.star(vertex)) {
    const double q = element_quality(input.quality_context(), positions, metric, at.element);
    least = std::min(least, q);
    sum += 1.0 / q;
  }
  return {least, static_cast<double>(input.topology.star(vertex).size()) / sum};
}

/// Follows an iteration vertex by vertex; `worth`: value of a place, by its least first metric and the position.
template <class Worth>
void follow(dmoscope::Run& run, const Worth& worth) {
  Progress progress;
  const InputMesh& input = run.input();
  std::uint64_t moved = 0, beyond = 0;
  for (std::uint64_t i = run.visits_per_iteration(); i > 0; --i) {
    const Index vertex = run.colouring().order[run.moment().visits];
    const std::vector<Vec3> positions(run.positions().begin(), run.positions().end());
    const auto composite =
        composite_objective_of_visit(run.parameters().metric, run.parameters().combination, run.size_field(), run.sweep(), run.guard());
    ASSERT_TRUE(composite);
    const VisitTrace trace = trace_visit(input, positions, run.fixed(), run.parameters().metric, run.parameters().search, vertex, composite,
                                         run.sweep().untangling);
    const std::uint64_t steps = run.step(StepUnit::Vertex, progress);
    moved += steps;
    ASSERT_TRUE(same_bits(trace.to, run.positions()[vertex])) << vertex;
    ASSERT_EQ(trace.end == VisitEnd::Moved, steps == 1);
    ASSERT_TRUE(trace.combined);
    ASSERT_FALSE(trace.fast);
    if (trace.untangling) continue;
    double best = trace.value_here;
    for (const TracedLevel& level : trace.levels) {
      double most = best;
      for (int k = 0; k < level.points * level.points; ++k) {
        const Vec3 place = trace.from + input.geometry.plane.lift(level.at(k));
        const auto slot = static_cast<std::size_t>(k);
        const auto [least, mean] = star_at(input, positions, run.parameters().metric, vertex, place);
        most = std::max(most, level.values[slot]);
        if (least <= 0.0 || std::abs(least - composite->threshold) < 1e-9) continue;
        const bool is_beyond = least > composite->threshold;
        beyond += is_beyond ? 1U : 0U;
        ASSERT_NEAR(level.values[slot], is_beyond ? composite->threshold + worth(positions, vertex, place, mean) : least, 1e-9) << vertex;
      }
      ASSERT_EQ(level.best.has_value(), most > best);
      if (level.best) {
        ASSERT_TRUE(same_bits(level.values[static_cast<std::size_t>(*level.best)], most));
      }
      best = most;
    }
  }
  EXPECT_GT(moved, 10U);
  EXPECT_GT(beyond, 1000U);
}

dmoscope::Run make_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(1), std::size_t{1} << 28U};
}

TEST(CompositeTrace, OfTwoMetrics) {
  const auto mesh = testing::input(testing::lattice(9, 0.3, 3));
  RunParameters parameters;
  parameters.combination = CompositeTerms{0.6, Metric::MinAngle};
  auto run = make_run(mesh, parameters);
  follow(run, [&](const std::vector<Vec3>& positions, Index vertex, Vec3 place, double) {
    return star_at(*mesh, positions, Metric::MinAngle, vertex, place).first;
  });
}

TEST(CompositeTrace, OfDensity) {
  const auto mesh = testing::input(testing::lattice(9, 0.3, 4));
  const Vec3 point{0.3, 0.3, 0.0};
  RunParameters parameters;
  parameters.combination = CompositeTerms{0.5, SizeFunction{SizeFunction::Kind::InverseDistance, point, {}}};
  auto run = make_run(mesh, parameters);
  follow(run, [&](const std::vector<Vec3>& positions, Index vertex, Vec3 place, double) {
    Vec3 sum{};
    double weights = 0.0, lengths = 0.0;
    for (const Incidence& at : mesh->topology.star(vertex)) {
      const Vec3 other = positions[mesh->mesh.elements.corners(at.element)[(at.corner + 1) % 3]];
      const double weight = length(other - point);  // 1 / h2
      sum = sum + weight * other;
      weights += weight;
      lengths += length(other - positions[vertex]);
    }
    const double edge = lengths / static_cast<double>(mesh->topology.star(vertex).size());
    const Vec3 away = place - (1.0 / weights) * sum;
    return 1.0 / (1.0 + dot(away, away) / (edge * edge));
  });
}

TEST(CompositeTrace, OfTheMeanAboveTheFloor) {
  const auto mesh = testing::input(testing::lattice(9, 0.3, 5));
  RunParameters parameters;
  parameters.then_mean = PhaseBegin{.patience = 2};
  auto run = make_run(mesh, parameters);
  Progress progress;
  while (!run.mean_since()) run.iterate(1, progress);
  follow(run, [](const std::vector<Vec3>&, Index, Vec3, double mean) { return mean; });
}

TEST(CompositeTrace, SaysWhatItsValuesAre) {
  const auto mesh = testing::input(testing::lattice(9, 0.2, 5));
  const Index vertex = 55;
  const auto look = [&](const CompositeObjective& composite) {
    return trace_visit(*mesh, mesh->mesh.positions, mesh->topology.boundary(), composite.first, {}, vertex, composite).value_phrase;
  };
  EXPECT_EQ(look(composite_objective(Metric::MeanRatio, {0.7, Metric::MinAngle}, nullptr)),
            "mean ratio up to 0.7, beyond it 0.7 + minimum angle");
  EXPECT_EQ(look(composite_objective(Metric::MeanRatio, {0.7}, std::make_shared<const SizeField>(mesh, SizeFunction{}))),
            "mean ratio up to 0.7, beyond it 0.7 + density");
  EXPECT_THAT(look(raise_mean_above(Metric::MeanRatio, 0.25)), HasSubstr("from there on 0.25 + mean of the star"));
}

}  // namespace
}  // namespace dmoscope
