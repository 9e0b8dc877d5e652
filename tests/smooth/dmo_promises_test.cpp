// Promises 1 to 3 of the program, on meshes of every kind of element and star, for every metric, in double and with every kind of vector
// instructions.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/run/run.h"
#include "core/smooth/kernels/lane_kernel.h"
#include "core/smooth/methods/dmo.h"
#include "tests/smooth/promises.h"
#include "tests/smooth/zoo.h"

namespace dmoscope {
namespace {

using testing::all_metrics;
using testing::Cells;
using testing::expect_fixed_stay;
using testing::expect_promise_one;
using testing::input;
using testing::kBudget;
using testing::lattice;
using testing::make_run;
using testing::Specimen;
using testing::title;

/// Tests of the plain search.
class PlainPromises : public ::testing::TestWithParam<Metric> {};

TEST_P(PlainPromises, NoVisitMakesAnythingWorseAndFixedVerticesKeepTheirBits) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed})
    for (const double jitter : {0.25, 0.9}) {  // valid, tangled
      const Specimen specimen{"lattice", lattice(12, jitter, 21, cells)};
      if (!testing::defined_for_all(GetParam(), specimen.mesh)) continue;
      RunParameters parameters;
      parameters.metric = GetParam();
      parameters.search.precision = Precision::Double;
      parameters.fixed = {40, 41, 80};
      dmoscope::Run run = make_run(input(specimen.mesh), parameters);
      expect_promise_one(specimen, run, 3);
      expect_fixed_stay(specimen, run);
      EXPECT_GT(run.history().records()[1].moved, 0U);
    }
}
INSTANTIATE_TEST_SUITE_P(Dmo, PlainPromises, ::testing::ValuesIn(all_metrics()), [](const auto& test) { return title(test.param); });

/// Case of the fast search, with each kind of vector instructions.
struct Case {
  Metric metric;
  SimdLevel level;
};
class Promises : public ::testing::TestWithParam<Case> {};

TEST_P(Promises, HoldOnEveryMeshWithTheSameBitsForAnyStepsThreadsAndInstructions) {
  const auto [metric, level] = GetParam();
  if (level > best_simd_level()) GTEST_SKIP() << "this processor has no " << name(level);
  constexpr std::uint64_t kIterations = 3;
  const auto one = std::make_shared<ThreadPool>(1), three = std::make_shared<ThreadPool>(3);
  Progress progress;
  for (const Specimen& specimen : testing::zoo()) {
    if (!testing::defined_for_all(metric, specimen.mesh)) continue;
    const auto mesh = input(specimen.mesh);
    RunParameters parameters;
    parameters.metric = metric;
    parameters.search = specimen.search;
    parameters.search.simd = level;
    for (Index v = 3; v < mesh->mesh.vertex_count(); v += 37) parameters.fixed.push_back(v);

    dmoscope::Run by_class(mesh, parameters, one, kBudget);
    expect_promise_one(specimen, by_class, kIterations);
    expect_fixed_stay(specimen, by_class);
    EXPECT_GT(by_class.history().records()[1].moved, 0U) << specimen.name;

    dmoscope::Run by_iteration(mesh, parameters, three, kBudget);
    by_iteration.iterate(kIterations, progress);
    EXPECT_TRUE(same_bits(by_class.positions(), by_iteration.positions())) << specimen.name << ", threads";

    parameters.search.simd = SimdLevel::Baseline;
    dmoscope::Run by_vertex(mesh, parameters, one, kBudget);
    while (by_vertex.moment().iteration < kIterations) by_vertex.step(StepUnit::Vertex, progress);
    EXPECT_TRUE(same_bits(by_class.positions(), by_vertex.positions())) << specimen.name << ", by vertex";
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const Metric metric : all_metrics())
    for (const SimdLevel level : {SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512}) cases.push_back({metric, level});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Dmo, Promises, ::testing::ValuesIn(all_cases()),
                         [](const auto& test) { return title(test.param.metric) + "_" + std::string(name(test.param.level)); });

TEST(Dmo, SameBitsForAnyThreadsAndInstructionsWhereClassesAreLarge) {
  constexpr std::uint64_t kIterations = 2;
  for (const Cells cells : {Cells::Triangles, Cells::Mixed}) {
    const auto mesh = input(lattice(100, 0.45, 22, cells));
    Progress progress;
    dmoscope::Run baseline = make_run(mesh, {.search = {.simd = SimdLevel::Baseline}}, 1);
    ASSERT_GT(baseline.colouring().members(0).size(), 2 * kLaneGrain) << "or there is nothing to share";
    baseline.iterate(kIterations, progress);
    for (const SimdLevel level : supported_simd_levels())
      for (const unsigned threads : {1U, 2U, 5U}) {
        if (level == SimdLevel::Baseline && threads == 1) continue;
        dmoscope::Run run = make_run(mesh, {.search = {.simd = level}}, threads);
        run.iterate(kIterations, progress);
        EXPECT_TRUE(same_bits(run.positions(), baseline.positions())) << threads << ", " << name(level);
      }
  }
}

TEST(Dmo, ScaledMeshSmoothsToTheScaledShape) {
  const Mesh base = lattice(20, 0.4, 23);
  Progress progress;
  dmoscope::Run reference = make_run(input(base), {});
  reference.iterate(10, progress);
  for (const double scale : {1e-5, 1e4, 1e-30, 1e30}) {
    Mesh scaled = base;
    for (Vec3& p : scaled.positions) p = scale * p;
    dmoscope::Run run = make_run(input(scaled), {});
    run.iterate(10, progress);
    EXPECT_NEAR(run.statistics().minimum, reference.statistics().minimum, 1e-4) << scale;
    EXPECT_EQ(run.statistics().inverted, 0U) << scale;
  }
}

TEST(Dmo, FarFromTheOriginAndInATiltedPlaneItReachesTheSameMinimum) {
  const Mesh base = lattice(20, 0.4, 24);
  Progress progress;
  dmoscope::Run reference = make_run(input(base), {});
  reference.iterate(10, progress);
  Mesh far = base, tilted = base;
  for (std::size_t v = 0; v < base.positions.size(); ++v) {
    const Vec3 p = base.positions[v];
    far.positions[v] = {p.x + 1e6, p.y + 1e6, 0};
    tilted.positions[v] = {0.6 * p.x + 7, p.y - 3, 0.8 * p.x + 2};
  }
  for (const Mesh* mesh : {&far, &tilted}) {
    const auto prepared = input(*mesh);
    dmoscope::Run run = make_run(prepared, {});
    run.iterate(10, progress);
    EXPECT_NEAR(run.statistics().minimum, reference.statistics().minimum, 1e-4);
    for (const Vec3 p : run.positions()) {  // all vertices stay in the plane
      const Plane& plane = prepared->geometry.plane;
      EXPECT_NEAR(dot(p - mesh->positions[0], plane.normal), 0.0, 1e-9);
    }
  }
}

TEST(Dmo, InPlanesParallelToTheCoordinatePlanesItFindsTheSameBits) {
  for (const Cells cells : {Cells::Triangles, Cells::Mixed}) {
    const Mesh base = lattice(15, 0.4, 29, cells);
    const auto smoothed = [](const Mesh& mesh) {
      dmoscope::Run run = make_run(input(mesh), {});
      Progress progress;
      run.iterate(3, progress);
      return std::vector<Vec3>(run.positions().begin(), run.positions().end());
    };
    const std::vector<Vec3> expected = smoothed(base);
    const auto in_yz = smoothed(testing::mapped(base, [](Vec3 p) { return Vec3{3, p.x, p.y}; }));
    const auto in_zx = smoothed(testing::mapped(base, [](Vec3 p) { return Vec3{p.y, 3, p.x}; }));
    for (std::size_t v = 0; v < expected.size(); ++v) {
      EXPECT_EQ(in_yz[v], (Vec3{3, expected[v].x, expected[v].y}));
      EXPECT_EQ(in_zx[v], (Vec3{expected[v].y, 3, expected[v].x}));
    }
  }
}

/// Visits each vertex of the first class once, by both searches from the same positions.
TEST(Dmo, TheFastSearchHasTheGridThePlainOneHas) {
  for (const Cells cells : {Cells::Triangles, Cells::Mixed})
    for (const int points : {2, 5, 8, 9, 16})
      for (const int levels : {1, 3, 5})
        for (const double omega : {0.5, 0.8}) {
          const auto mesh = input(lattice(20, 0.3, 30, cells));
          RunParameters parameters;
          parameters.search = {.grid_points = points, .levels = levels, .omega = omega};
          dmoscope::Run fast = make_run(mesh, parameters);
          parameters.search.precision = Precision::Double;
          dmoscope::Run plain = make_run(mesh, parameters);
          Progress progress;
          fast.step(StepUnit::Class, progress);
          plain.step(StepUnit::Class, progress);
          std::size_t different = 0;
          const auto members = fast.colouring().members(0);
          for (const Index v : members) different += length(fast.positions()[v] - plain.positions()[v]) > 1e-6 / 20 ? 1U : 0U;
          EXPECT_LE(different, members.size() / 20) << points << ' ' << levels << ' ' << omega;
        }
}

TEST(Dmo, FloatAndDoubleReachTheSameMinimum) {
  const auto mesh = input(lattice(40, 0.4, 25));
  Progress progress;
  RunParameters parameters;
  dmoscope::Run in_float = make_run(mesh, parameters);
  parameters.search.precision = Precision::Double;
  dmoscope::Run in_double = make_run(mesh, parameters);
  in_float.iterate(20, progress);
  in_double.iterate(20, progress);
  EXPECT_NEAR(in_float.statistics().minimum, in_double.statistics().minimum, 2e-3);
  EXPECT_GT(in_float.statistics().minimum, 0.3);
}

TEST(Dmo, UntanglesALattice) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const auto mesh = input(lattice(12, 1.2, 26, cells));
    Progress progress;
    dmoscope::Run run = make_run(mesh, {});
    ASSERT_GT(run.statistics().inverted, 5U);
    run.iterate(60, progress);
    EXPECT_EQ(run.statistics().inverted, 0U);
  }
}

TEST(Dmo, ShuffledOrderIsReproducibleAndDiffersFromTheNaturalOne) {
  const auto mesh = input(lattice(20, 0.4, 27));
  Progress progress;
  dmoscope::Run a = make_run(mesh, {.order = {7}}), b = make_run(mesh, {.order = {7}}), c = make_run(mesh, {.order = {8}}),
                natural = make_run(mesh, {});
  for (dmoscope::Run* run : {&a, &b, &c, &natural}) run->iterate(3, progress);
  EXPECT_TRUE(same_bits(a.positions(), b.positions()));
  EXPECT_FALSE(same_bits(a.positions(), c.positions()));
  EXPECT_FALSE(same_bits(a.positions(), natural.positions()));
}

TEST(Dmo, AMeshOfASinglePrecisionFileIsPutOnFloatsAndStillNeverGetsWorse) {
  Mesh coarse = lattice(20, 0.4, 28);
  for (Vec3& p : coarse.positions) p = {static_cast<float>(p.x + 1e5), static_cast<float>(p.y + 1e5), 0};  // numbers are 1/128 apart there
  coarse.single_precision = true;
  const auto mesh = input(coarse);
  dmoscope::Run run = make_run(mesh, {});
  Progress progress;
  // Rounding undoes many gains of the search here: without the confirmation in double visits would lose quality.
  for (int iteration = 0; iteration < 5; ++iteration) {
    for (const Index vertex : std::vector<Index>(run.colouring().order)) {
      const StarState before = star_state(*mesh, run.positions(), Metric::MeanRatio, vertex);
      run.step(StepUnit::Vertex, progress);
      const StarState after = star_state(*mesh, run.positions(), Metric::MeanRatio, vertex);
      EXPECT_GE(after.jacobian, std::min(before.jacobian, 0.0));
      if (before.jacobian > 0.0) {
        EXPECT_GE(after.quality, before.quality);
      }
      const Vec3 p = run.positions()[vertex];
      EXPECT_EQ(p.x, static_cast<float>(p.x));
      EXPECT_EQ(p.y, static_cast<float>(p.y));
    }
  }
  EXPECT_GT(run.history().records()[1].moved, 0U);
}

TEST(Dmo, HighValenceStarWorks) {
  Mesh mesh;
  mesh.name = "wheel";
  mesh.positions.push_back({0.7, 0.2, 0});
  constexpr Index kSpokes = 500;
  for (Index i = 0; i < kSpokes; ++i) mesh.positions.push_back({std::cos(2 * M_PI * i / kSpokes), std::sin(2 * M_PI * i / kSpokes), 0});
  for (Index i = 0; i < kSpokes; ++i) testing::add(mesh, {0, 1 + i, 1 + (i + 1) % kSpokes});
  Progress progress;
  dmoscope::Run run = make_run(input(std::move(mesh)), {});
  run.iterate(5, progress);
  EXPECT_LT(std::hypot(run.positions()[0].x, run.positions()[0].y), 1e-2) << "the hub belongs in the middle";
}

}  // namespace
}  // namespace dmoscope
