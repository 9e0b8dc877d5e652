// Curved surfaces: vertices never leave the input's surface, faces deviate by no more than the bound, and nothing folds over.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/mesh/generate.h"
#include "core/numeric/simd.h"
#include "tests/smooth/surface_judge.h"
#include "tests/smooth/surface_zoo.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

using namespace testing;
using ::testing::HasSubstr;

TEST(SlidingOnSurfaces, KeepTheirPromisesAfterEveryIteration) {
  std::size_t moved = 0;
  for (const Specimen& specimen : surfaces()) {
    const auto mesh = input(specimen.mesh);
    ASSERT_EQ(mesh->geometry.shape, Shape::Surface) << specimen.name;
    for (const Metric metric : {Metric::MeanRatio, Metric::MinAngle, Metric::ScaledJacobian}) {
      if (!defined_for_all(metric, specimen.mesh)) continue;
      for (const BoundaryRule boundary : {BoundaryRule::Fixed, BoundaryRule::Slide}) {
        const SurfaceJudge judge(specimen, *mesh, 1e-3);
        RunParameters parameters = sliding_by();
        parameters.metric = metric;
        parameters.boundary = boundary;
        dmoscope::Run run = make_run(mesh, parameters);
        for (std::uint64_t iteration = 1; iteration <= (kSanitized ? 1 : 3); ++iteration) {
          expect_promise_one(specimen, run, iteration);
          judge.expect_kept(run);
          expect_in_order(specimen, run);
          expect_fixed_stay(specimen, run);
          if (::testing::Test::HasFatalFailure()) return;
        }
        moved += slid(run);
      }
    }
  }
  EXPECT_GT(moved, kSanitized ? 400U : 1500U);
}

TEST(SlidingOnSurfaces, OtherMethodsKeepToTheSurface) {
  for (const char* method : {"smart-laplace", "pattern-search", "laplace", "dvr", "active-set", "angle-based"})
    EXPECT_GT(expect_kept_by(method, surfaces(), kSanitized ? 5 : 2, kSanitized ? 1 : 3), kSanitized ? 20U : 300U) << method;
}

/// Laplacian smoothing on a sphere that is round enough goes to the mean of the neighbours, straight down.
TEST(SlidingOnSurfaces, LaplaceGoesToTheMean) {
  const Mesh start = skin(mapped(shaken(test::volume_grid(8, test::Fill::Hexahedra), 0.02, 7), ball), Cells::Quadrilaterals);
  const auto mesh = input(start);
  for (const double share : {1.0, 0.5}) {
    RunParameters parameters;
    parameters.method = "laplace";
    parameters.options.relaxation = share;
    parameters.max_deviation = 1.0;
    dmoscope::Run run = make_run(mesh, parameters);
    Progress progress;
    run.step(StepUnit::Vertex, progress);
    const Index v = run.colouring().order[0];
    Vec3 sum{};
    double count = 0.0;
    for (Index e = 0; e < start.elements.size(); ++e) {
      const auto c = start.elements.corners(e);
      for (std::size_t i = 0; i < 4; ++i)
        if (c[i] == v) sum = sum + start.positions[c[(i + 1) % 4]] + start.positions[c[(i + 3) % 4]], count += 2.0;
    }
    const Vec3 here = start.positions[v], way = share * (1.0 / count * sum - here), now = run.positions()[v];
    const Vec3 along = way - dot(way, here) * here, went = (now - here) - dot(now - here, here) * here;
    EXPECT_GT(length(went), 0.0);
    EXPECT_LT(length(went - along), 0.05 * length(along)) << share;  // the facets' normals are not quite the sphere's
  }
}

/// A thousand surfaces, smooth and rough, some of which fold over themselves.
TEST(SlidingOnSurfaces, RandomOnesKeepTheirPromises) {
  std::size_t moved = 0;
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 60U : 1000U); ++seed) {
    dmoscope::testing::Random random(seed);
    Mesh start = lattice(5, random(0.0, 0.8), seed,
                         seed % 3 == 0   ? Cells::Mixed
                         : seed % 3 == 1 ? Cells::Triangles
                                         : Cells::Quadrilaterals);
    const double rough = random(0.0, 1.0), noise = 0.3 * rough * rough, bend = random(-3.0, 3.0), wave = random(0.0, 0.3),
                 way = random(2.0, 9.0);
    for (Vec3& p : start.positions) {
      const double x = p.x, z = wave * std::sin(way * x + p.y) + noise * random(-1.0, 1.0);
      p = std::abs(bend) < 0.1 ? Vec3{x, p.y, z} : Vec3{(1 / bend + z) * std::sin(bend * x), p.y, (1 / bend + z) * std::cos(bend * x)};
    }
    const Specimen specimen{"random " + std::to_string(seed), start};
    const auto mesh = input(start);
    if (!mesh->is_surface()) continue;
    const SurfaceJudge judge(specimen, *mesh, 1e-2);
    RunParameters parameters = sliding_by(1e-2);
    parameters.boundary = seed % 2 == 0 ? BoundaryRule::Fixed : BoundaryRule::Slide;
    dmoscope::Run run = make_run(mesh, parameters);
    if (run.visits_per_iteration() == 0) continue;  // so rough that each vertex is a corner
    for (std::uint64_t iteration = 1; iteration <= 2; ++iteration) {
      expect_promise_one(specimen, run, iteration);
      judge.expect_kept(run, true);
      if (::testing::Test::HasFatalFailure()) return;
    }
    moved += slid(run);
  }
  EXPECT_GT(moved, kSanitized ? 200U : 5000U);
}

/// Vertices of a sphere, a torus and a cylinder stay between the surface itself and its facets' middles.
TEST(SlidingOnSurfaces, AnalyticDistances) {
  struct Case {
    const char* name;
    Mesh mesh;
    double (*off)(Vec3);  // distance from the surface, negative inside
  };
  std::vector<Case> cases;
  cases.push_back({"sphere", skin(mapped(shaken(test::volume_grid(8, test::Fill::Hexahedra), 0.03, 7), ball), Cells::Triangles),
                   [](Vec3 p) { return length(p) - 1; }});
  cases.push_back({"torus", wound(40, 14, true, false, 8, Cells::Triangles, on_torus),
                   [](Vec3 p) { return std::hypot(std::hypot(p.x, p.y) - 2, p.z) - 0.7; }});
  cases.push_back(
      {"cylinder", wound(24, 8, false, false, 9, Cells::Triangles, on_cylinder), [](Vec3 p) { return std::hypot(p.x, p.y) - 1; }});
  for (const Case& one : cases) {
    const auto mesh = input(one.mesh);
    dmoscope::Run run = make_run(mesh, sliding_by(0.01));
    Progress progress;
    run.iterate(10, progress);
    double most = 0.0;  // distance of the facets' points from the surface that their corners lie on
    for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
      const auto c = mesh->mesh.elements.corners(e);
      for (double u = 0; u <= 1.0; u += 0.1)
        for (double v = 0; u + v <= 1.0 + 1e-9; v += 0.1)
          most = std::max(most, std::abs(one.off((1 - u - v) * one.mesh.positions[c[0]] + u * one.mesh.positions[c[1]] +
                                                 v * one.mesh.positions[c[2]])));
    }
    EXPECT_GT(slid(run), 50U) << one.name;
    EXPECT_GT(run.statistics().minimum, run.history().records().front().statistics.minimum) << one.name;
    for (const Vec3& p : run.positions()) ASSERT_LE(std::abs(one.off(p)), 1.1 * most) << one.name;
  }
}

/// Results have the same bits with any number of threads and every width of instructions, in one run or in steps, after going back, and
/// with other aims.
TEST(SlidingOnSurfaces, AreTheSameBits) {
  const auto all = surfaces();
  for (std::size_t i = 0; i < all.size(); i += 4) {  // each kind once, with one kind of cells or another
    const Specimen& specimen = all[i];
    const auto mesh = input(specimen.mesh);
    Progress progress;
    for (const int aims : {0, 1, 2}) {
      RunParameters parameters = sliding_by();
      if (aims == 1) parameters.then_mean = PhaseBegin{.patience = 2};
      if (aims == 2) parameters.combination = CompositeTerms{0.3, Metric::ScaledJacobian};
      dmoscope::Run expected = make_run(mesh, parameters);
      expected.iterate(3, progress);
      for (const unsigned threads : {2U, 8U}) {
        dmoscope::Run run = make_run(mesh, parameters, threads);
        run.iterate(3, progress);
        ASSERT_TRUE(same_bits(run.positions(), expected.positions())) << specimen.name << ", aims " << aims;
      }
      for (const SimdLevel level : supported_simd_levels()) {
        RunParameters other = parameters;
        other.search.simd = level;
        dmoscope::Run run = make_run(mesh, other);
        run.iterate(3, progress);
        ASSERT_TRUE(same_bits(run.positions(), expected.positions())) << specimen.name << ", aims " << aims << ": " << name(level);
      }
      dmoscope::Run stepped = make_run(mesh, parameters, 2);
      stepped.seek({2, stepped.visits_per_iteration() / 3}, progress);
      stepped.seek({1, 0}, progress);
      stepped.seek({3, 0}, progress);
      ASSERT_TRUE(same_bits(stepped.positions(), expected.positions())) << specimen.name << ", aims " << aims << ": seek";
    }
  }
}

/// Borders between groups of elements stay, slide along themselves, or are ignored.
TEST(SlidingOnSurfaces, BordersOfGroups) {
  Mesh start = mapped(lattice(10, 0.0, 3), [](Vec3 p) { return Vec3{p.x + 0.03 * std::sin(40 * p.x * p.y), p.y, 0.2 * p.x * p.x}; });
  Group left{.name = "left", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
  for (Index e = 0; e < start.elements.size() / 2; ++e) left.members.push_back(e);
  start.groups = {left};
  const auto mesh = input(start);
  const auto row = [](Index v) { return v / 11 == 5 && v % 11 > 0 && v % 11 < 10; };
  for (const InterfaceRule rule : {InterfaceRule::Fixed, InterfaceRule::Slide, InterfaceRule::Free}) {
    RunParameters parameters;
    parameters.interfaces = rule;
    dmoscope::Run run = make_run(mesh, parameters);
    for (Index v = 0; v < start.vertex_count(); ++v) {
      if (!row(v)) continue;
      EXPECT_EQ(run.domain()->on_curve(v), rule == InterfaceRule::Slide) << "vertex " << v;
      EXPECT_EQ(run.domain()->on_surface(v), rule == InterfaceRule::Free) << "vertex " << v;
    }
  }
}

}  // namespace
}  // namespace dmoscope
