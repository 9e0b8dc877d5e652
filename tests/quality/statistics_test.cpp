// Statistics of whole meshes, against plain loops.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/thread_pool.h"
#include "core/mesh/generate.h"
#include "core/quality/quality.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::input;
using testing::lattice;

TEST(Statistics, AgreesWithAPlainLoop) {
  const auto mesh = input(lattice(20, 0.8, 3, Cells::Mixed));
  const QualityContext context = mesh->quality_context();
  const auto& positions = mesh->mesh.positions;
  std::vector<std::uint8_t> fixed(positions.size(), 0);
  for (std::size_t v = 0; v < fixed.size() / 2; ++v) fixed[v] = 1;
  const Statistics statistics = compute_statistics(context, positions, Metric::MeanRatio, fixed, nullptr);
  double least = 2, least_movable = 2, least_fixed = 2, sum = 0;
  Index inverted = 0;
  for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
    const double q = element_quality(context, positions, Metric::MeanRatio, e);
    bool movable = false;
    for (const Index v : mesh->mesh.elements.corners(e)) movable = movable || fixed[v] == 0;
    least = std::min(least, q);
    (movable ? least_movable : least_fixed) = std::min(movable ? least_movable : least_fixed, q);
    sum += q;
    inverted += q <= 0 ? 1 : 0;  // for the mean ratio the sign is the validity
  }
  EXPECT_EQ(statistics.minimum, least);
  EXPECT_EQ(statistics.movable_minimum, least_movable);
  EXPECT_EQ(statistics.ceiling, least_fixed);
  EXPECT_EQ(statistics.inverted, inverted);
  EXPECT_GT(inverted, 0U) << "the example should hold inverted elements";
  EXPECT_NEAR(statistics.mean, sum / mesh->mesh.elements.size(), 1e-14);
  EXPECT_EQ(element_quality(context, positions, Metric::MeanRatio, statistics.worst_element), least);
}

TEST(Statistics, BoundsOfMovableAndImmovableElementsWhereverTheyLie) {
  const auto mesh = input(lattice(60, 0.7, 9));
  const auto& positions = mesh->mesh.positions;
  const QualityContext context = mesh->quality_context();
  testing::Random random(5);
  for (const double share : {0.0, 0.3, 0.9, 1.0}) {
    std::vector<std::uint8_t> fixed(positions.size());
    for (std::uint8_t& f : fixed) f = random() < share ? 1 : 0;
    double movable = INFINITY, ceiling = INFINITY;
    std::vector<Index> immovable;
    for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
      const auto c = mesh->mesh.elements.corners(e);
      const bool all = fixed[c[0]] != 0 && fixed[c[1]] != 0 && fixed[c[2]] != 0;
      if (all) immovable.push_back(e);
      double& bound = all ? ceiling : movable;
      bound = std::min(bound, element_quality(context, positions, Metric::RadiusRatio, e));
    }
    ThreadPool pool(2);
    EXPECT_EQ(immovable_elements(mesh->mesh, fixed, &pool), immovable);
    for (const Statistics& s : {compute_statistics(context, positions, Metric::RadiusRatio, immovable, nullptr),
                                compute_statistics(context, positions, Metric::RadiusRatio, fixed, &pool)}) {
      EXPECT_EQ(s.movable_minimum, movable) << share;
      EXPECT_EQ(s.ceiling, ceiling) << share;
      EXPECT_EQ(s.minimum, std::min(movable, ceiling)) << share;
    }
  }
}

TEST(Statistics, TheWorstElementIsTheFirstOfEqualOnes) {
  const auto mesh = input(lattice(100, 0.0, 1));  // all alike, if rounded alike
  const std::vector<std::uint8_t> fixed(mesh->mesh.positions.size(), 0);
  const Statistics s = compute_statistics(mesh->quality_context(), mesh->mesh.positions, Metric::MeanRatio, fixed, nullptr);
  Index first = 0;
  while (element_quality(mesh->quality_context(), mesh->mesh.positions, Metric::MeanRatio, first) != s.minimum) ++first;
  EXPECT_EQ(s.worst_element, first);
}

TEST(Statistics, SameBitsForAnyPool) {
  const auto mesh = input(lattice(120, 0.4, 4));
  const std::vector<std::uint8_t> fixed(mesh->mesh.positions.size(), 0);
  const auto at = [&](ThreadPool* pool) {
    return compute_statistics(mesh->quality_context(), mesh->mesh.positions, Metric::RadiusRatio, fixed, pool);
  };
  const Statistics alone = at(nullptr);
  for (const unsigned threads : {1U, 2U, 3U, 7U}) {
    ThreadPool pool(threads);
    EXPECT_EQ(at(&pool).mean, alone.mean) << threads;
    EXPECT_EQ(at(&pool).minimum, alone.minimum) << threads;
    EXPECT_EQ(at(&pool).worst_element, alone.worst_element) << threads;
  }
}

/// The order of addition, also for many processes and a device: elements within stretches of 1,024 by four lanes, stretches within groups
/// of 1,024, groups.
TEST(Statistics, TheMeanIsAddedUpInStretchesAndGroups) {
  Progress unwatched;
  const auto mesh = prepare_input(generate_mesh("grid", 560'000, 1, unwatched), {}, Need::QualityOnly, unwatched);
  const std::size_t count = mesh->mesh.elements.size();
  ASSERT_GT(count, std::size_t{1} << 20U);
  std::vector<double> quality(count);
  element_qualities(mesh->quality_context(), mesh->mesh.positions, Metric::MeanRatio, nullptr, quality);
  std::array<double, 4> all{};
  for (std::size_t group = 0; group < count; group += 1024 * 1024) {
    std::array<double, 4> of_group{};
    for (std::size_t stretch = group; stretch < std::min(count, group + 1024 * 1024); stretch += 1024) {
      std::array<double, 4> of_stretch{};
      for (std::size_t e = stretch; e < std::min(count, stretch + 1024); ++e) of_stretch[e % 4] += quality[e];
      for (std::size_t lane = 0; lane < 4; ++lane) of_group[lane] += of_stretch[lane];
    }
    for (std::size_t lane = 0; lane < 4; ++lane) all[lane] += of_group[lane];
  }
  const double mean = ((all[0] + all[1]) + (all[2] + all[3])) / static_cast<double>(count);
  ThreadPool pool(2);
  for (ThreadPool* threads : {static_cast<ThreadPool*>(nullptr), &pool})
    EXPECT_EQ(compute_statistics(mesh->quality_context(), mesh->mesh.positions, Metric::MeanRatio, std::span<const Index>(), threads).mean,
              mean);
}

TEST(Statistics, QualityDoesNotDependOnTheOriginOrThePlane) {
  const Mesh flat = lattice(10, 0.3, 5);
  Mesh moved = flat, tilted = flat;
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (std::size_t v = 0; v < flat.positions.size(); ++v) {
    const Vec3 p = flat.positions[v];
    moved.positions[v] = {p.x + 1048576.0, p.y - 2097152.0, 5.0};
    tilted.positions[v] = {c * p.x, p.y, s * p.x};
  }
  const auto a = input(flat), b = input(moved), t = input(tilted);
  for (const MetricInfo& entry : metric_table())
    for (Index e = 0; e < flat.elements.size() && entry.defined_for(ElementKind::Triangle); ++e) {
      const double q = element_quality(a->quality_context(), a->mesh.positions, entry.metric, e);
      EXPECT_NEAR(element_quality(b->quality_context(), b->mesh.positions, entry.metric, e), q, 1e-6) << entry.name;
      EXPECT_NEAR(element_quality(t->quality_context(), t->mesh.positions, entry.metric, e), q, 1e-6) << entry.name;
    }
}

TEST(Statistics, UndefinedMetricIsNaNForTheKindAndLeftOutOfTheMean) {
  const auto mesh = input(lattice(6, 0.2, 6, Cells::Mixed));
  const std::vector<std::uint8_t> fixed(mesh->mesh.positions.size(), 0);
  double sum = 0;
  int count = 0;
  for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
    const double q = element_quality(mesh->quality_context(), mesh->mesh.positions, Metric::MinAngle, e);
    EXPECT_EQ(std::isnan(q), mesh->mesh.elements.kind(e) == ElementKind::Quadrilateral);
    if (std::isnan(q)) continue;
    sum += q;
    ++count;
  }
  const Statistics statistics = compute_statistics(mesh->quality_context(), mesh->mesh.positions, Metric::MinAngle, fixed, nullptr);
  EXPECT_NEAR(statistics.mean, sum / count, 1e-14);
  EXPECT_THROW(require_defined(Metric::MinAngle, mesh->mesh), UsageError);
}

TEST(Surfaces, SquaresOfACubeAreIdealWhicheverWayTheyFace) {
  Mesh cube;
  cube.name = "cube";
  for (int i = 0; i < 8; ++i) cube.positions.push_back({i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0});
  for (const auto& face : {std::initializer_list<Index>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    testing::add(cube, face);
  const auto mesh = input(cube, Need::QualityOnly);
  ASSERT_EQ(mesh->geometry.shape, Shape::Surface);
  EXPECT_TRUE(mesh->report.inverted_elements.empty());
  EXPECT_EQ(mesh->report.flipped_elements, 0U);
  for (Index e = 0; e < 6; ++e)
    EXPECT_NEAR(element_quality(mesh->quality_context(), mesh->mesh.positions, Metric::MeanRatio, e), 1.0, 1e-15);
}

TEST(Findings, ADuplicateElementIsNeitherTurnedOverNorInverted) {
  Mesh mesh;
  mesh.name = "double";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  for (const auto& t : {std::initializer_list<Index>{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}}) testing::add(mesh, t);
  const auto prepared = input(mesh);
  EXPECT_EQ(prepared->report.duplicate_elements, std::vector<Index>{4});
  EXPECT_TRUE(prepared->report.inverted_elements.empty());
  EXPECT_EQ(prepared->report.flipped_elements, 0U);
}

TEST(Findings, ScaleDoesNotMakeElementsDegenerate) {
  for (const double scale : {1e-70, 1e-30, 1e30, 1e70}) {
    Mesh mesh = lattice(4, 0.2, 8);
    for (Vec3& p : mesh.positions) p = scale * p;
    EXPECT_TRUE(input(mesh)->report.degenerate_elements.empty()) << scale;
  }
  Mesh huge = lattice(4, 0.2, 8);
  for (Vec3& p : huge.positions) p = 1e160 * p;
  EXPECT_THROW((void)input(huge), InputError);
}

TEST(ThreadPool, CoversEveryIndexOnceAndPassesExceptionsOn) {
  ThreadPool pool(3);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{999}, std::size_t{5000}}) {
    std::vector<std::atomic<int>> seen(count);
    pool.parallel_for(count, 64, [&](std::size_t first, std::size_t last) {
      EXPECT_EQ(first % 64, 0U);
      for (std::size_t i = first; i < last; ++i) ++seen[i];
    });
    for (const auto& n : seen) EXPECT_EQ(n, 1);
  }
  EXPECT_THROW(pool.parallel_for(1000, 10,
                                 [](std::size_t first, std::size_t) {
                                   if (first == 500) throw UsageError("x");
                                 }),
               UsageError);
}

TEST(ThreadPool, LoopsMayFollowEachOtherAtOnceOrAfterAWhile) {
  for (const unsigned threads : {2U, 9U}) {  // 9: probably more than processors
    ThreadPool pool(threads);
    std::vector<std::size_t> sums(64, 0);
    for (int loop = 0; loop < 3000; ++loop) {
      if (loop % 1000 == 999) std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the threads fall asleep
      pool.parallel_for(sums.size(), 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) sums[i] += i;
      });
    }
    for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(sums[i], 3000 * i);
  }
}

}  // namespace
}  // namespace dmoscope
