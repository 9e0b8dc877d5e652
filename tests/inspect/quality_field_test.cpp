// The quality around a vertex against the judges of whole meshes, and its best place against an independent search without discs.

#include "core/inspect/quality_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/thread_pool.h"
#include "core/mesh/generate.h"
#include "tests/smooth/zoo.h"
#include "tests/support/moving_quality.h"

namespace dmoscope {
namespace {

using V = Vec2<double>;

/// A fan of triangles around a hub, counter-clockwise.
std::shared_ptr<const InputMesh> fan(Vec3 hub, const std::vector<V>& ring) {
  Mesh mesh;
  mesh.positions.push_back(hub);
  for (const V& p : ring) mesh.positions.push_back({p.x, p.y, 0.0});
  const auto n = static_cast<Index>(ring.size());
  for (Index i = 0; i < n; ++i) testing::add(mesh, {0, 1 + i, 1 + (i + 1) % n});
  return testing::input(std::move(mesh));
}

/// Least 4 sqrt(3) A / (sum of squared edges) of the fan with its hub at `p`.
double mean_ratio(const std::vector<V>& ring, V p) {
  double least = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const V b = ring[i], c = ring[(i + 1) % ring.size()];
    const double area = 0.5 * ((b.x - p.x) * (c.y - p.y) - (c.x - p.x) * (b.y - p.y));
    const auto square = [](V d) { return d.x * d.x + d.y * d.y; };
    least = std::min(least, 4.0 * std::sqrt(3.0) * area / (square(b - p) + square(c - p) + square(c - b)));
  }
  return least;
}

/// A ring that is visible from the origin, so that there is a place without inverted elements.
std::vector<V> random_ring(testing::Random& random, std::size_t n) {
  std::vector<V> ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * (static_cast<double>(i) + random(-0.3, 0.3)) / static_cast<double>(n), radius = random(0.3, 1.0);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

/// The maximum of a function with convex upper level sets, by a search along directions around the best so far, finer and finer.
V climb(const std::function<double(V)>& value, V start, double step) {
  V best = start;
  double highest = value(best);
  while (step > 1e-13) {
    bool rose = false;
    for (int i = 0; i < 360; ++i) {
      const double angle = 2 * M_PI * i / 360;
      const V p{best.x + step * std::cos(angle), best.y + step * std::sin(angle)};
      if (const double there = value(p); there > highest) highest = there, best = p, rose = true;
    }
    if (!rose) step *= 0.5;
  }
  return best;
}

TEST(LocalOptimum, OfARegularHexagonIsItsMiddle) {
  std::vector<V> ring;
  for (int i = 0; i < 6; ++i) ring.push_back({5.0 + 2.0 * std::cos(i * M_PI / 3), 2.0 * std::sin(i * M_PI / 3)});
  for (const Vec3 hub : {Vec3{5.7, 0.2, 0}, Vec3{5, 0, 0}, Vec3{9, 1, 0}}) {  // aside, there already, outside
    const auto input = fan(hub, ring);
    const auto best = local_optimum(*input, input->mesh.positions, Metric::MeanRatio, 0);
    ASSERT_TRUE(best);
    EXPECT_NEAR(best->at.x, 5.0 - hub.x, 2e-9);
    EXPECT_NEAR(best->at.y, 0.0 - hub.y, 2e-9);
    EXPECT_NEAR(best->quality, 1.0, 1e-12);
  }
}

/// Two mirrored pairs decide: the optimum of a rhombus is the middle, with four equal triangles.
TEST(LocalOptimum, OfARhombusIsItsMiddle) {
  const double a = 1.0, b = 0.4;
  const auto input = fan({0.1, 0.05, 0}, {{a, 0}, {0, b}, {-a, 0}, {0, -b}});
  const auto best = local_optimum(*input, input->mesh.positions, Metric::MeanRatio, 0);
  ASSERT_TRUE(best);
  EXPECT_NEAR(best->at.x, -0.1, 1e-9);
  EXPECT_NEAR(best->at.y, -0.05, 1e-9);
  EXPECT_NEAR(best->quality, std::sqrt(3.0) * a * b / (a * a + b * b), 1e-12);
}

TEST(LocalOptimum, IsWhereAPatternSearchEnds) {
  testing::Random random(7);
  for (int round = 0; round < 100; ++round) {
    const std::vector<V> ring = random_ring(random, 3 + static_cast<std::size_t>(random(0, 9)));
    const Vec3 hub{random(-0.2, 0.2), random(-0.2, 0.2), 0.0};
    const auto input = fan(hub, ring);
    const auto best = local_optimum(*input, input->mesh.positions, Metric::MeanRatio, 0);
    if (!(mean_ratio(ring, {0, 0}) > 0.0)) continue;  // a sector as wide as a half-plane
    ASSERT_TRUE(best) << round;
    const V at{hub.x + best->at.x, hub.y + best->at.y};
    EXPECT_NEAR(mean_ratio(ring, at), best->quality, 1e-12);
    const auto quality = [&](V p) { return mean_ratio(ring, p); };
    const V climbed = climb(quality, {0, 0}, 0.5);
    EXPECT_GE(best->quality, quality(climbed) - 1e-13) << round;
    EXPECT_NEAR(best->quality, quality(climbed), 1e-5) << round << ": sharp ridges stop it early";
    const V again = climb(quality, at, 1e-4);  // no higher value nearby
    EXPECT_LE(quality(again), best->quality + 1e-13) << round;
    EXPECT_NEAR(std::hypot(again.x - at.x, again.y - at.y), 0.0, 1e-9) << round;
  }
}

TEST(LocalOptimum, OfATangledStarIsThatOfTheSameStarUntangled) {
  testing::Random random(8);
  for (int round = 0; round < 50; ++round) {
    const std::vector<V> ring = random_ring(random, 6);
    const auto input = fan({0, 0, 0}, ring);
    std::vector<Vec3> outside = input->mesh.positions;
    outside[0] = {3 * ring[0].x, 3 * ring[0].y, 0};
    const auto a = local_optimum(*input, input->mesh.positions, Metric::MeanRatio, 0);
    const auto b = local_optimum(*input, outside, Metric::MeanRatio, 0);
    ASSERT_TRUE(a && b) << round;
    EXPECT_NEAR(a->at.x, 3 * ring[0].x + b->at.x, 5e-9);
    EXPECT_NEAR(a->at.y, 3 * ring[0].y + b->at.y, 5e-9);
  }
}

TEST(LocalOptimum, IsThereOnlyWhereItCanBe) {
  const auto mixed = testing::input(testing::lattice(6, 0.2, 3, testing::Cells::Mixed));
  const auto of = [&](Index vertex, Metric metric) { return local_optimum(*mixed, mixed->mesh.positions, metric, vertex); };
  EXPECT_FALSE(of(8, Metric::MeanRatio)) << "quadrilaterals";
  EXPECT_TRUE(of(12, Metric::MeanRatio));
  EXPECT_FALSE(of(12, Metric::MinAngle));
  // A ring like a spiral: no place sees all of it.
  const auto star = fan({0, 0, 0}, {{1, 0}, {0.1, 0.1}, {0, 1}, {-0.1, 0.1}, {-1, 0}, {-1, 5}, {-3, -3}, {3, -3}, {3, 5}, {1, 5}});
  EXPECT_FALSE(local_optimum(*star, star->mesh.positions, Metric::MeanRatio, 0));
}

TEST(LocalOptimum, OfStarsLargeAndFarAwayIsQuickAndTrue) {
  testing::Random random(9);
  for (const std::size_t n : {40U, 300U}) {
    std::vector<V> ring = random_ring(random, n), moved = ring;
    for (V& p : moved) p = {1e6 + 1e-3 * p.x, -2e6 + 1e-3 * p.y};
    const auto near = fan({0.01, 0.01, 0}, ring), far = fan({1e6 + 1e-5, -2e6 + 1e-5, 0}, moved);
    const auto a = local_optimum(*near, near->mesh.positions, Metric::MeanRatio, 0);
    const auto b = local_optimum(*far, far->mesh.positions, Metric::MeanRatio, 0);
    ASSERT_TRUE(a && b);
    EXPECT_GE(a->quality, mean_ratio(ring, climb([&](V p) { return mean_ratio(ring, p); }, {0, 0}, 0.1)) - 1e-13);
    EXPECT_NEAR(a->quality, b->quality, 1e-4) << "a micrometre at 2,000 km is 2^-12 of the last digit of a double's";
  }
}

TEST(QualityField, HasAtEachSampleWhatTheJudgesOfMeshesSay) {
  const auto input = testing::input(testing::lattice(7, 0.4, 45, testing::Cells::Mixed));
  ThreadPool two(2);
  for (const MetricInfo& entry : metric_table())
    for (const Index vertex : {9U, 11U, 14U, 0U, 4U}) {
      std::vector<Vec3> positions = input->mesh.positions;
      const Vec3 hub = positions[vertex];
      const QualityField field = sample_quality(*input, positions, entry.metric, vertex, {-0.2, -0.1}, {0.1, 0.2}, 6, 40);
      const QualityField shared = sample_quality(*input, positions, entry.metric, vertex, {-0.2, -0.1}, {0.1, 0.2}, 6, 40, &two);
      EXPECT_EQ(field.jacobian, shared.jacobian);
      ASSERT_EQ(field.quality.size(), 240U);
      for (int row = 0; row < 40; ++row)
        for (int column = 0; column < 6; ++column) {
          positions[vertex] = {hub.x - 0.2 + 0.05 * (column + 0.5), hub.y - 0.1 + 0.0075 * (row + 0.5), 0.0};
          double quality = 1e300, jacobian = 1e300;
          bool defined = true;
          for (const Incidence& at : input->topology.star(vertex)) {
            defined = defined && entry.defined_for(input->mesh.elements.kind(at.element));
            quality = std::min(quality, element_quality(input->quality_context(), positions, entry.metric, at.element));
            jacobian = std::min(jacobian,
                                smallest_jacobian(input->quality_context(), positions, at.element) / input->reference_measure[at.element]);
          }
          const auto i = static_cast<std::size_t>(row * 6 + column);
          EXPECT_NEAR(field.jacobian[i], jacobian, 1e-6 * (1.0 + std::fabs(jacobian)));
          EXPECT_EQ(std::isnan(field.quality[i]), !defined);
          if (defined) {
            EXPECT_NEAR(field.quality[i], quality, 1e-6) << entry.name << ' ' << vertex << ' ' << row << ' ' << column;
          }
        }
    }
}

/// The kernel of the ring, cut out of a large square by the half-planes left of its edges.
std::vector<V> kernel(const std::vector<V>& ring) {
  std::vector<V> polygon{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const V a = ring[i], d = ring[(i + 1) % ring.size()] - a;
    const auto left = [&](V p) { return d.x * (p.y - a.y) - d.y * (p.x - a.x); };
    std::vector<V> rest;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const V p = polygon[k], q = polygon[(k + 1) % polygon.size()];
      const double at_p = left(p), at_q = left(q);
      if (at_p >= 0) rest.push_back(p);
      if ((at_p < 0) != (at_q < 0)) rest.push_back({p.x + (q.x - p.x) * at_p / (at_p - at_q), p.y + (q.y - p.y) * at_p / (at_p - at_q)});
    }
    polygon = rest;
  }
  return polygon;
}

TEST(QualityField, NothingIsInvertedExactlyInTheKernel) {
  testing::Random random(10);
  for (int round = 0; round < 20; ++round) {
    const std::vector<V> ring = random_ring(random, 7), polygon = kernel(ring);
    const auto input = fan({0, 0, 0}, ring);
    const QualityField field = sample_quality(*input, input->mesh.positions, Metric::MeanRatio, 0, {-1.1, -1.1}, {1.1, 1.1}, 200, 200);
    double low_x = 9, high_x = -9, area = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const V p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
      area += 0.5 * (p.x * q.y - p.y * q.x);
    }
    int inside = 0;
    for (std::size_t i = 0; i < field.jacobian.size(); ++i) {
      EXPECT_EQ(field.jacobian[i] > 0.0F, field.quality[i] > 0.0F);
      if (!(field.jacobian[i] > 0.0F)) continue;
      ++inside;
      const double x = -1.1 + 2.2 * (static_cast<double>(i % 200) + 0.5) / 200;
      EXPECT_GE(x, low_x);
      EXPECT_LE(x, high_x);
    }
    const double cell = 2.2 / 200, perimeter = 4 * (high_x - low_x) + 4 * cell;
    EXPECT_NEAR(inside * cell * cell, area, perimeter * cell) << round;
  }
}

/// A slice of a volume mesh is sampled; the offset along its axis is constant.
TEST(QualityField, OfASliceHasAtEachSampleWhatTheJudgesOfMeshesSay) {
  Progress progress;
  for (const char* kind : {"tetrahedra", "hexahedra", "solids"}) {
    const auto input = testing::input(generate_mesh(kind, 125, 4, progress));
    ThreadPool two(2);
    std::size_t valid = 0, inverted = 0;
    for (const Metric metric : {Metric::MeanRatio, Metric::RadiusRatio})
      for (Index vertex = 0; vertex < input->mesh.vertex_count(); vertex += 13)
        for (const int axis : {0, 1, 2}) {
          std::vector<Vec3> positions = input->mesh.positions;
          const Vec3 hub = positions[vertex];
          const double size = 2 * length(positions[input->mesh.elements.corners(input->topology.star(vertex)[0].element)[0]] -
                                         positions[input->mesh.elements.corners(input->topology.star(vertex)[0].element)[1]]);
          const StarSlice slice{axis, 0.2 * size};
          const V low{-0.6 * size, -0.3 * size}, high{0.3 * size, 0.6 * size};
          const QualityField field = sample_slice(*input, positions, metric, vertex, slice, low, high, 4, 20);
          EXPECT_EQ(field.jacobian, sample_slice(*input, positions, metric, vertex, slice, low, high, 4, 20, &two).jacobian);
          for (int row = 0; row < 20; row += 3)
            for (int column = 0; column < 4; ++column) {
              const double u = low.x + 0.225 * size * (column + 0.5), v = low.y + 0.045 * size * (row + 0.5), w = 0.2 * size;
              positions[vertex] = hub + (axis == 0 ? Vec3{w, u, v} : axis == 1 ? Vec3{u, w, v} : Vec3{u, v, w});
              const double quality = testing::moving_quality(*input, positions, metric, vertex);
              double jacobian = 1e300;
              bool defined = true;
              for (const Incidence& at : input->topology.star(vertex)) {
                defined = defined && info(metric).defined_for(input->mesh.elements.kind(at.element));
                jacobian = std::min(jacobian, smallest_jacobian(input->quality_context(), positions, at.element));
              }
              const auto i = static_cast<std::size_t>(row * 4 + column);
              EXPECT_EQ(field.jacobian[i] > 0.0F, jacobian > 0.0) << kind << ' ' << vertex << ' ' << axis;
              EXPECT_EQ(std::isnan(field.quality[i]), !defined);
              (jacobian > 0.0 ? valid : inverted) += 1;
              if (defined && jacobian > 0.0) {
                EXPECT_NEAR(field.quality[i], quality, 1e-6) << kind << ' ' << vertex << ' ' << axis;
              }
            }
        }
    EXPECT_GT(valid, 100U) << kind;
    EXPECT_GT(inverted, 100U) << kind;
  }
}

TEST(QualityField, ASliceLeadsIntoItsPlaneAndBack) {
  for (const int axis : {0, 1, 2}) {
    const StarSlice slice{axis, 7.0};
    const Vec3 there = slice.lift({2.0, 3.0});
    const double along[] = {there.x, there.y, there.z};
    EXPECT_EQ(along[axis], 7.0);
    EXPECT_EQ(slice.project(there), (V{2.0, 3.0}));
  }
}

TEST(QualityField, RefusesWhatIsNotThere) {
  Mesh mesh = testing::lattice(3, 0.2, 1);
  mesh.positions.push_back({5, 5, 0});
  const auto input = testing::input(std::move(mesh));
  const auto sample = [&](Index vertex, int columns) {
    return sample_quality(*input, input->mesh.positions, Metric::MeanRatio, vertex, {-1, -1}, {1, 1}, columns, 2);
  };
  EXPECT_NO_THROW((void)sample(5, 2));
  EXPECT_THROW((void)sample(5, 1), UsageError);
  EXPECT_THROW((void)sample(16, 2), UsageError) << "of no element";
  EXPECT_THROW((void)sample(17, 2), UsageError);
  EXPECT_FALSE(local_optimum(*input, input->mesh.positions, Metric::MeanRatio, 16));
  EXPECT_THROW((void)sample_slice(*input, input->mesh.positions, Metric::MeanRatio, 5, {}, {-1, -1}, {1, 1}, 2, 2), UsageError) << "planar";
}

}  // namespace
}  // namespace dmoscope
