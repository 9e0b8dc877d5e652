// Joint moves before a phase that raises a mean: the sum of 1 / quality falls within a floor, where no single vertex can move.

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/joint/joint_mesh.h"
#include "tests/smooth/promises.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using namespace testing;

/// Regular hexagon of radius 1 about a vertex that is displaced.
Mesh displaced_fan(double x, double y) {
  Mesh mesh;
  mesh.positions.push_back({x, y, 0.0});
  for (int k = 0; k < 6; ++k) mesh.positions.push_back({std::cos(k * std::numbers::pi / 3.0), std::sin(k * std::numbers::pi / 3.0), 0.0});
  for (Index k = 0; k < 6; ++k) mesh.elements.add(ElementKind::Triangle, std::array<Index, 3>{0, 1 + k, 1 + (k + 1) % 6});
  return mesh;
}

/// Place where the sum of 1 / quality is least for the fan's vertex, with all qualities above a floor.
Vec3 placed_by_the_sum(double x, double y, double floor) {
  const auto mesh = input(displaced_fan(x, y));
  std::vector<std::uint8_t> fixed(7, 1);
  fixed[0] = 0;
  const JointMesh<2> joint(*mesh, Metric::MeanRatio, fixed);
  LocalProblem<2> local = joint.problem(joint.free_vertices(), mesh->mesh.positions);
  local.problem.limited = &joint.function();
  local.problem.limits.assign(local.problem.atoms.size(), joint.function().inverse_of(floor));
  Progress progress;
  const JointSolution<2> found = solve_joint<2>(local.problem, joint.function(), {.gap = 1e-8}, {}, progress);
  EXPECT_EQ(found.end, InteriorPointEnd::Gap);
  return joint.placed(mesh->mesh.positions[0], found.best[0], local.scale);
}

TEST(ClusterMean, TheSumOfARegularFanIsLeastInItsMiddle) {
  for (const auto& [x, y] : {std::pair{0.3, 0.1}, std::pair{-0.5, 0.4}, std::pair{0.02, -0.6}}) {
    const Vec3 at = placed_by_the_sum(x, y, 0.05);
    EXPECT_NEAR(at.x, 0.0, 1e-4);
    EXPECT_NEAR(at.y, 0.0, 1e-4);
  }
}

double harmonic_mean(const InputMesh& mesh, std::span<const Vec3> positions, Metric metric) {
  double sum = 0.0;
  const Index count = mesh.mesh.elements.size();
  for (Index e = 0; e < count; ++e) sum += 1.0 / element_quality(mesh.quality_context(), positions, metric, e);
  return count / sum;
}

struct Ended {
  double minimum, mean;
  Index inverted;
};
Ended raised(const InputMesh& mesh, std::span<const std::uint8_t> fixed, const JointOptions& options, Metric metric = Metric::MeanRatio,
             std::optional<Guard> guard = {}, const JointSliding& sliding = {}) {
  const JointObjective guarded = guard ? JointObjective(guard->metric, CompositeTerms{guard->floor, metric}) : JointObjective(metric);
  JointClusters clusters(mesh, guarded, fixed, sliding);
  std::vector<Vec3> positions = mesh.mesh.positions;
  JointState state;
  Progress progress;
  const auto judged = [&] {
    return compute_statistics(mesh.quality_context(), std::span<const Vec3>(positions), metric, std::span<const Index>(), nullptr);
  };
  Statistics before = judged();
  for (int call = 0; call < 40; ++call) {
    const std::vector<Vec3> old = positions;
    const auto cluster = clusters.raise_worst(positions, state, options, progress);
    if (!cluster) break;
    const Statistics now = judged();
    EXPECT_GE(now.minimum, before.minimum) << "call " << call;
    EXPECT_LE(now.inverted, before.inverted) << "call " << call;
    for (Index v = 0; v < old.size(); ++v)
      if (fixed[v] != 0) {
        EXPECT_TRUE(same_bits(std::span(positions).subspan(v, 1), std::span(old).subspan(v, 1))) << "vertex " << v;
      }
    before = now;
    if (!guard) continue;
    for (Index e = 0; e < mesh.mesh.elements.size(); ++e) {
      EXPECT_GT(element_quality(mesh.quality_context(), std::span<const Vec3>(positions), guard->metric, e), guard->floor) << e;
    }
  }
  return {before.minimum, harmonic_mean(mesh, positions, metric), before.inverted};
}

/// Mesh with all vertices displaced, those of the boundary, too, so that no lattice is the best.
Mesh roughened(Mesh mesh, double spacing) {
  std::mt19937 random(5);
  const auto offset = [&] { return 0.15 * spacing * (static_cast<double>(random()) / 4294967296.0 * 2.0 - 1.0); };
  const bool volume = info(mesh.elements.kind(0)).dimension == 3;
  for (Vec3& p : mesh.positions) {
    p = p + Vec3{offset(), offset(), 0.0};
    if (volume) p.z += offset();
  }
  return mesh;
}

TEST(ClusterMean, RaisesTheMeanAndGivesUpNoMoreOfTheMinimumThanTheGap) {
  constexpr double kGap = 0.01;
  const std::vector<std::pair<std::string, Mesh>> meshes{
      {"triangles", roughened(lattice(12, 0.35, 4), 1.0 / 12)},
      {"quadrilaterals", roughened(lattice(10, 0.3, 6, Cells::Quadrilaterals), 0.1)},
      {"both", roughened(lattice(10, 0.3, 7, Cells::Mixed), 0.1)},
      {"tetrahedra", roughened(test::volume_grid(5, test::Fill::Tetrahedra, 0.2, 2), 0.2)},
      {"hexahedra", roughened(test::volume_grid(5, test::Fill::Hexahedra, 0.2, 3), 0.2)},
      {"wedges", roughened(test::volume_grid(4, test::Fill::Wedges, 0.2, 3), 0.25)},
      {"all solids", roughened(test::volume_grid(4, test::Fill::Mixed, 0.2, 3), 0.25)}};
  for (const auto& [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    const auto held = input(mesh);
    const dmoscope::Run run = make_run(held, {});
    const Ended plain = raised(*held, run.fixed(), {.gap = 0.5 * kGap});  // the minimum's limit before the mean rises
    const Ended tight = raised(*held, run.fixed(), {.gap = 1e-4});
    const Ended both = raised(*held, run.fixed(), {.gap = kGap, .mean = MeanKind::Harmonic});
    EXPECT_GE(both.minimum, (1.0 - 1.01 * kGap) * tight.minimum);
    EXPECT_GT(both.mean, plain.mean);
    EXPECT_EQ(both.inverted, 0U);
  }
}

TEST(ClusterMean, RisesWhereVerticesSlide) {
  constexpr double kGap = 0.01;
  for (const test::Fill fill : {test::Fill::Tetrahedra, test::Fill::Hexahedra, test::Fill::Wedges}) {
    Mesh leaning = test::volume_grid(3, fill, 0.2, 3);
    for (Vec3& p : leaning.positions) p.x += 0.6 * p.y + 0.3 * p.z;
    const auto mesh = input(std::move(leaning));
    const dmoscope::Run run = make_run(mesh, {.boundary = BoundaryRule::Slide});
    const JointSliding sliding{run.domain(), run.parameters().max_deviation * mesh->geometry.size};
    ASSERT_TRUE(sliding.domain);
    const Ended held = raised(*mesh, make_run(mesh, {}).fixed(), {.gap = 0.5 * kGap});
    const Ended plain = raised(*mesh, run.fixed(), {.gap = 0.5 * kGap}, Metric::MeanRatio, {}, sliding);
    const Ended both = raised(*mesh, run.fixed(), {.gap = kGap, .mean = MeanKind::Harmonic}, Metric::MeanRatio, {}, sliding);
    EXPECT_GT(plain.minimum, held.minimum) << "else nothing slides";
    EXPECT_GE(both.minimum, (1.0 - 2.0 * kGap) * plain.minimum);
    EXPECT_GT(both.mean, plain.mean);
  }
}

TEST(ClusterMean, OfAFormulaIsThatOfTheMetricThatItSays) {
  constexpr double kGap = 0.01;
  const Metric formula = parse_metric("formula:2*det/norm^2");
  for (const Cells cells : {Cells::Triangles, Cells::Mixed}) {
    const auto mesh = input(roughened(lattice(10, 0.3, 7, cells), 0.1));
    const dmoscope::Run run = make_run(mesh, {});
    const Ended plain = raised(*mesh, run.fixed(), {.gap = 0.5 * kGap}, formula);
    const Ended both = raised(*mesh, run.fixed(), {.gap = kGap, .mean = MeanKind::Harmonic}, formula);
    const Ended built_in = raised(*mesh, run.fixed(), {.gap = kGap, .mean = MeanKind::Harmonic});
    EXPECT_GT(both.mean, plain.mean);
    EXPECT_NEAR(both.mean, built_in.mean, 0.01);
    EXPECT_NEAR(both.minimum, built_in.minimum, 2.0 * kGap * built_in.minimum);
  }
}

/// A strained lattice, and apart from it a flat fan around a vertex that is at its best place: its elements are the worst of all.
Mesh with_a_flat_fan(Mesh mesh, double strain) {
  for (Vec3& p : mesh.positions) p.x += strain * p.y * p.y;
  const Index first = mesh.vertex_count();
  for (const Vec3& p : displaced_fan(0.0, 0.0).positions) mesh.positions.push_back({3.0 + p.x, 0.05 * p.y, 0.0});
  for (Index k = 0; k < 6; ++k) add(mesh, {first, first + 1 + k, first + 1 + (k + 1) % 6});
  return mesh;
}

std::array<Index, std::size(kMeanSteps)> below_steps(const InputMesh& mesh, std::span<const Vec3> positions) {
  std::array<Index, std::size(kMeanSteps)> below{};
  for (Index e = 0; e < mesh.mesh.elements.size(); ++e)
    for (std::size_t i = 0; i < below.size(); ++i)
      below[i] += element_quality(mesh.quality_context(), positions, Metric::MeanRatio, e) < kMeanSteps[i] ? 1 : 0;
  return below;
}

/// A push would let elements fall almost to the worst one, and gain nothing: that is held by its neighbours.
TEST(ClusterMean, LeavesNoMoreBadElementsWhereTheWorstIsHeldAtOnce) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    SCOPED_TRACE(seed);
    const auto mesh = input(with_a_flat_fan(lattice(14, 0.3, seed), 1.2));
    dmoscope::Run run = make_run(mesh, {});
    Progress progress;
    run.iterate(100, progress);
    const std::vector<Vec3> from(run.positions().begin(), run.positions().end());
    const auto raised_once = input([&] {
      Mesh copy = mesh->mesh;
      copy.positions = from;
      return copy;
    }());
    JointClusters clusters(*raised_once, Metric::MeanRatio, run.fixed());
    std::vector<Vec3> positions = from;
    JointState state;
    const JointOptions options{.gap = 3e-3, .push_first = true, .mean = MeanKind::Harmonic};
    const auto first = clusters.raise_worst(positions, state, options, progress);
    ASSERT_TRUE(first && first->certified && !first->is_push);
    while (clusters.raise_worst(positions, state, options, progress)) {
    }
    EXPECT_EQ(state.end, JointState::End::Certified);
    const auto before = below_steps(*mesh, from), after = below_steps(*mesh, positions);
    ASSERT_GT(before[0], 10U) << "else there is no tail";
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE(after[i], before[i]) << "below " << kMeanSteps[i];
    EXPECT_GT(harmonic_mean(*mesh, positions, Metric::MeanRatio), 1.01 * harmonic_mean(*mesh, from, Metric::MeanRatio));
  }
}

TEST(ClusterMean, KeepsAGuard) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals}) {
    const auto mesh = input(roughened(lattice(10, 0.3, 7, cells), 0.1));
    const dmoscope::Run run = make_run(mesh, {});
    const double least =
        compute_statistics(mesh->quality_context(), std::span(mesh->mesh.positions), Metric::MeanRatio, run.immovable(), nullptr).minimum;
    const Guard guard{Metric::MeanRatio, 0.999 * least};
    const Ended plain = raised(*mesh, run.fixed(), {.gap = 0.005}, Metric::ScaledJacobian, guard);
    const Ended both = raised(*mesh, run.fixed(), {.gap = 0.01, .mean = MeanKind::Harmonic}, Metric::ScaledJacobian, guard);
    EXPECT_GT(both.mean, plain.mean);
    EXPECT_GE(both.minimum, 0.98 * plain.minimum);
  }
}

}  // namespace
}  // namespace dmoscope
