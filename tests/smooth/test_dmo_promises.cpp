// Promises 1 to 3 of the program, on random meshes of every kind of element, for every metric and both precisions.

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "core/session/run.h"
#include "core/smooth/dmo.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::input;
using testing::lattice;

constexpr std::size_t kBudget = std::size_t{1} << 28U;

dmoscope::Run make_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters, unsigned threads = 1) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(threads), kBudget};
}

bool same_bits(std::span<const Vec3> a, std::span<const Vec3> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

struct Case {
  Cells cells;
  double jitter;
  Metric metric;
  Precision precision;
};

class Promises : public ::testing::TestWithParam<Case> {};

TEST_P(Promises, NoVisitMakesAnythingWorseAndFixedVerticesKeepTheirBits) {
  const Case& c = GetParam();
  const auto mesh = input(lattice(12, c.jitter, 21, c.cells));
  RunParameters parameters;
  parameters.metric = c.metric;
  parameters.search.precision = c.precision;
  parameters.fixed = {40, 41, 80};
  dmoscope::Run run = make_run(mesh, parameters);
  Progress progress;
  for (int iteration = 0; iteration < 3; ++iteration) {
    for (const Index vertex : std::vector<Index>(run.colouring().order)) {
      const StarState before = star_state(*mesh, run.positions(), c.metric, vertex);
      const Vec3 old = run.positions()[vertex];
      const Statistics all_before = run.statistics();
      run.step(StepUnit::Vertex, progress);
      const StarState after = star_state(*mesh, run.positions(), c.metric, vertex);
      const Statistics all_after = run.statistics();
      if (old == run.positions()[vertex]) continue;
      if (before.jacobian <= 0) {
        EXPECT_GT(after.jacobian, before.jacobian);
      } else {
        EXPECT_GT(after.jacobian, 0.0) << "a valid star was inverted";
        EXPECT_GT(after.quality, before.quality);
      }
      if (all_before.inverted == 0) {
        EXPECT_EQ(all_after.inverted, 0U);
        EXPECT_GE(all_after.minimum, all_before.minimum);
      }
    }
  }
  for (Index v = 0; v < mesh->mesh.vertex_count(); ++v)
    if (run.fixed()[v] != 0) {
      EXPECT_TRUE(same_bits(std::span(&mesh->mesh.positions[v], 1), std::span(&run.positions()[v], 1)));
    }
  EXPECT_TRUE(run.fixed()[40] != 0 && run.fixed()[0] != 0);
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const MetricInfo& entry : metric_table())
    for (const Precision precision : {Precision::Float, Precision::Double})
      for (const double jitter : {0.25, 0.9}) {  // valid, tangled
        cases.push_back({Cells::Triangles, jitter, entry.metric, precision});
        if (!entry.quadrilaterals) continue;
        cases.push_back({Cells::Quadrilaterals, jitter, entry.metric, precision});
        cases.push_back({Cells::Mixed, jitter, entry.metric, precision});
      }
  return cases;
}
INSTANTIATE_TEST_SUITE_P(AllMetrics, Promises, ::testing::ValuesIn(all_cases()));

TEST(Dmo, SameBitsForAnyNumberOfThreadsAndAnyWayOfStepping) {
  const auto mesh = input(lattice(60, 0.45, 22, Cells::Mixed));
  Progress progress;
  dmoscope::Run one = make_run(mesh, {}, 1);
  one.iterate(5, progress);
  for (const unsigned threads : {2U, 5U}) {
    dmoscope::Run many = make_run(mesh, {}, threads);
    many.iterate(5, progress);
    EXPECT_TRUE(same_bits(one.positions(), many.positions())) << threads;
  }
  dmoscope::Run by_class = make_run(mesh, {}, 2);
  while (by_class.moment().iteration < 5) by_class.step(StepUnit::Class, progress);
  EXPECT_TRUE(same_bits(one.positions(), by_class.positions()));
  dmoscope::Run by_vertex = make_run(mesh, {}, 2);
  while (by_vertex.moment().iteration < 5) by_vertex.step(StepUnit::Vertex, progress);
  EXPECT_TRUE(same_bits(one.positions(), by_vertex.positions()));
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
    for (const Vec3 p : run.positions()) {  // nobody leaves the plane
      const Plane& plane = prepared->geometry.plane;
      EXPECT_NEAR(dot(p - mesh->positions[0], plane.normal), 0.0, 1e-9);
    }
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
  for (Vec3& p : coarse.positions) p = {static_cast<float>(p.x + 1e5), static_cast<float>(p.y + 1e5), 0};  // 1/128 apart there
  coarse.single_precision = true;
  const auto mesh = input(coarse);
  dmoscope::Run run = make_run(mesh, {});
  Progress progress;
  // Rounding undoes many a win of the search here: without the confirmation in double visits would lose quality.
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
