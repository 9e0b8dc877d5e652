// Vertices that slide on the surface of a volume: they never leave the input's, keep their order along its feature edges, and faces deviate
// by no more than the bound and do not fold over. All by plain geometry against the input's faces.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/mesh/generate.h"
#include "core/numeric/simd.h"
#include "tests/smooth/surface_judge.h"
#include "tests/support/sanitized.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using namespace testing;
using test::Fill;
using test::volume_grid;

Vec3 rod(Vec3 p) {  // a block's four sides become a cylinder's
  const Vec3 q{2 * p.x - 1, 2 * p.y - 1, 0};
  const double most = std::max(std::abs(q.x), std::abs(q.y)), size = length(q);
  return size > 0.0 ? Vec3{most / size * q.x, most / size * q.y, 3 * p.z} : Vec3{0, 0, 3 * p.z};
}
Vec3 twisted(Vec3 p) {
  const double angle = 0.8 * p.z, x = p.x - 0.5, y = p.y - 0.5;
  return {x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle), 2 * p.z};
}
Vec3 uneven(Vec3 p) { return {p.x, p.y, p.z * p.z}; }
Vec3 wavy(Vec3 p) { return {p.x, p.y, p.z + 0.08 * std::sin(7 * p.x) * std::cos(5 * p.y)}; }

/// Two blocks that share nothing, an edge or a vertex; or whose facing sides are 1e-6 apart.
Mesh two(Mesh mesh, Vec3 shift) {
  const auto count = static_cast<Index>(mesh.positions.size());
  const Mesh one = mesh;
  for (const Vec3 p : one.positions) mesh.positions.push_back(p + shift);
  for (Index e = 0; e < one.elements.size(); ++e) {
    std::vector<Index> corners;
    for (const Index v : one.elements.corners(e)) corners.push_back(v + count);
    mesh.elements.add(one.elements.kind(e), corners);
  }
  return mesh;
}
/// Joins vertices at one place.
Mesh joined(const Mesh& mesh) {
  Mesh result;
  std::map<std::array<double, 3>, Index> known;
  std::vector<Index> now;
  for (const Vec3& p : mesh.positions) {
    const auto [at, added] = known.try_emplace({p.x, p.y, p.z}, static_cast<Index>(result.positions.size()));
    if (added) result.positions.push_back(p);
    now.push_back(at->second);
  }
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    std::vector<Index> corners;
    for (const Index v : mesh.elements.corners(e)) corners.push_back(now[v]);
    result.elements.add(mesh.elements.kind(e), corners);
  }
  return result;
}

std::vector<Specimen> volume_specimens() {
  std::vector<Specimen> all;
  std::uint64_t seed = 70;
  const Index n = 3;
  for (const Fill fill : {Fill::Hexahedra, Fill::Tetrahedra, Fill::Mixed}) {
    ++seed;
    const auto block = [&](double jitter, double shake) {
      return shaken(volume_grid(n, fill, jitter, static_cast<unsigned>(seed)), shake / n, seed);
    };
    all.push_back({"cube", block(0.3, 0.4)});
    all.push_back({"cube, tangled", block(0.6, 0.7)});
    all.push_back({"ball", mapped(block(0.2, 0.25), ball)});
    all.push_back({"rod", mapped(block(0.2, 0.25), rod)});
    all.push_back({"twisted", mapped(block(0.2, 0.3), twisted)});
    all.push_back({"wavy", mapped(block(0.2, 0.3), wavy)});
    all.push_back({"flat", mapped(block(0.2, 0.3), [](Vec3 p) { return Vec3{100 * p.x, p.y, 0.01 * p.z}; })});
    all.push_back({"tilted, far", mapped(block(0.2, 0.3), [](Vec3 p) {
                     return Vec3{1e4 + 0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y - 1e4, p.z};
                   })});
    all.push_back({"tiny", mapped(block(0.2, 0.3), [](Vec3 p) { return 1e-9 * p; })});
    Mesh single = mapped(block(0.2, 0.3), [](Vec3 p) {
      const Vec3 q = ball(p);
      return Vec3{static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
    });
    single.single_precision = true;
    all.push_back({"single precision", std::move(single)});
    all.push_back({"two sheets", two(block(0.2, 0.3), {0, 0, 1 + 1e-6})});
    all.push_back({"at an edge", mapped(joined(two(volume_grid(n, fill), {1, 1, 0})), uneven)});
    all.push_back({"at a vertex", mapped(joined(two(volume_grid(n, fill), {1, 1, 1})), uneven)});
  }
  Progress progress;
  all.push_back({"tetrahedra", generate_mesh("tetrahedra", 60, 3, progress)});
  all.push_back({"tangled", generate_mesh("tangled-solids", 130, 3, progress)});
  return all;
}

class SlidingInSpace : public ::testing::TestWithParam<Metric> {};

TEST_P(SlidingInSpace, KeepsItsPromisesAfterEveryIteration) {
  std::size_t moved = 0;
  for (const Specimen& specimen : volume_specimens()) {
    if (!defined_for_all(GetParam(), specimen.mesh)) continue;
    const auto mesh = input(specimen.mesh);
    for (const double bound : {1e-3, 0.05}) {
      const SurfaceJudge judge(specimen, *mesh, bound);
      RunParameters parameters = sliding_by(bound);
      parameters.metric = GetParam();
      dmoscope::Run run = make_run(mesh, parameters);
      ASSERT_NE(run.domain(), nullptr);
      for (std::uint64_t iteration = 1; iteration <= (kSanitized ? 1 : 3); ++iteration) {
        expect_promise_one(specimen, run, iteration);
        judge.expect_kept(run);
        expect_in_order(specimen, run);
        if (::testing::Test::HasFatalFailure()) return;
      }
      moved += slid(run);
    }
  }
  EXPECT_GT(moved, kSanitized ? 100U : 400U);
}

/// Each cluster of joint moves may move many sliding vertices.
TEST(SlidingInSpaceTogether, KeepsItsPromisesAfterEveryCluster) {
  EXPECT_GT(expect_kept_by("joint", volume_specimens(), kSanitized ? 5 : 1, kSanitized ? 1 : 2), kSanitized ? 5U : 100U);
}

/// A box of hexahedra, crowded on its faces and edges: its optimum is known, and reached only by sliding.
TEST(SlidingInSpaceTogether, FindsTheLattice) {
  constexpr Index n = 3;
  Mesh mesh;
  testing::Random random(5);
  const auto at = [](Index i, Index j, Index k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (Index k = 0; k <= n; ++k)
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) {
        const auto shaken = [&](Index x) { return (x + (x > 0 && x < n ? random(-0.25, 0.25) : 0.0)) / n; };
        mesh.positions.push_back({shaken(i), shaken(j), shaken(k)});
      }
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i)
        mesh.elements.add(ElementKind::Hexahedron,
                          std::array{at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
                                     at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
  const auto prepared = input(mesh);
  RunParameters fixed, slides = sliding_by();
  fixed.method = slides.method = "joint";
  Progress progress;
  dmoscope::Run held = make_run(prepared, fixed), free = make_run(prepared, slides);
  held.until_converged({}, progress);
  const Outcome outcome = free.until_converged({}, progress);
  EXPECT_LT(held.statistics().minimum, 0.9);
  EXPECT_GT(free.statistics().minimum, 0.9995);
  EXPECT_EQ(outcome.reason, StopReason::Certified) << outcome.sentence();
}

TEST(SlidingInSpaceByOthers, KeepTheirPromisesAfterEveryIteration) {
  for (const char* method : {"smart-laplace", "pattern-search", "laplace", "dvr", "active-set"})
    EXPECT_GT(expect_kept_by(method, volume_specimens(), kSanitized ? 5 : 2, kSanitized ? 1 : 2), kSanitized ? 5U : 50U) << method;
}

INSTANTIATE_TEST_SUITE_P(Metrics, SlidingInSpace, ::testing::Values(Metric::MeanRatio, Metric::ScaledJacobian, Metric::MinAngle),
                         [](const auto& tested) {
                           std::string name(dmoscope::info(tested.param).name);
                           std::erase(name, '-');
                           return name;
                         });

/// Rods whose worst elements touch the surface: with a fixed surface they stay as bad.
TEST(SlidingInSpaceGains, SweptRods) {
  for (const char* name : {"screw", "elbow"}) {
    Progress progress;
    const auto mesh = input(generate_mesh(name, 1000, 4, progress));
    dmoscope::Run held = make_run(mesh, {}), free = make_run(mesh, sliding_by());
    held.iterate(15, progress);
    free.iterate(15, progress);
    EXPECT_GT(free.statistics().minimum, held.statistics().minimum + 0.005) << name;
  }
}

/// The sides of a cube are planes, which coordinates never leave by a bit.
TEST(SlidingInSpaceExactly, ACubeStaysOne) {
  for (const Fill fill : {Fill::Hexahedra, Fill::Tetrahedra, Fill::Mixed}) {
    const Mesh start = shaken(volume_grid(5, fill, 0.4, 9), 0.09, 9);
    const auto mesh = input(start);
    dmoscope::Run run = make_run(mesh, sliding_by());
    Progress progress;
    run.iterate(10, progress);
    EXPECT_GT(run.statistics().minimum, run.history().records().front().statistics.minimum);
    for (Index v = 0; v < start.vertex_count(); ++v) {
      const auto sides = [](Vec3 p) { return std::array{p.x == 0.0, p.x == 1.0, p.y == 0.0, p.y == 1.0, p.z == 0.0, p.z == 1.0}; };
      ASSERT_EQ(sides(run.positions()[v]), sides(start.positions[v])) << "vertex " << v;
    }
  }
}

/// Elements that are bad at a fixed surface become good if it slides.
TEST(SlidingInSpaceGains, WhatTheSurfaceHolds) {
  for (const Fill fill : {Fill::Hexahedra, Fill::Tetrahedra}) {
    const auto mesh = input(shaken(volume_grid(5, fill), 0.13, 4));
    Progress progress;
    dmoscope::Run held = make_run(mesh, {}), free = make_run(mesh, sliding_by());
    held.iterate(30, progress);
    free.iterate(30, progress);
    EXPECT_GT(free.statistics().minimum, 1.2 * held.statistics().minimum);
  }
}

/// A sphere's vertices stay on the facets of the input, hence between its circumscribed and its inscribed sphere.
TEST(SlidingInSpaceAnalytic, ASphereKeepsItsRadius) {
  const Mesh start = mapped(shaken(volume_grid(6, Fill::Tetrahedra, 0.1, 2), 0.04, 2), ball);
  const auto mesh = input(start);
  double inner = 1.0;  // the least distance of a facet's plane from the centre
  for (const auto& f : boundary_faces(start)) {
    const Vec3 a = start.positions[f[0]], n = unit(cross(start.positions[f[1]] - a, start.positions[f[2]] - a));
    inner = std::min(inner, std::abs(dot(a, n)));
  }
  dmoscope::Run run = make_run(mesh, sliding_by(0.02));
  Progress progress;
  run.iterate(10, progress);
  EXPECT_GT(slid(run), 50U);
  for (Index v = 0; v < start.vertex_count(); ++v) {
    if (mesh->topology.boundary()[v] == 0) continue;
    ASSERT_LE(length(run.positions()[v]), 1.0 + 1e-12);
    ASSERT_GE(length(run.positions()[v]), inner - 1e-12);
  }
}

/// Interfaces between regions slide on themselves; where they meet the boundary, along their rim.
TEST(SlidingInSpaceInside, InterfacesStayWhereTheyAre) {
  for (const Fill fill : {Fill::Hexahedra, Fill::Tetrahedra}) {
    constexpr Index n = 6;
    Mesh mesh = volume_grid(n, fill, 0.3, 5);
    Group lower{.name = "lower", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
    for (Index e = 0; e < mesh.elements.size() / 2; ++e) lower.members.push_back(e);
    mesh.groups = {lower};
    dmoscope::testing::Random random(8);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {  // the middle layer lies on a plane, and is jittered there
      if (v / ((n + 1) * (n + 1)) != n / 2) continue;
      Vec3& p = mesh.positions[v];
      p.z = 0.5;
      const Index i = v % (n + 1), j = v / (n + 1) % (n + 1);
      p.x = (i + (i > 0 && i < n ? random(-0.4, 0.4) : 0.0)) / n;
      p.y = (j + (j > 0 && j < n ? random(-0.4, 0.4) : 0.0)) / n;
    }
    const auto prepared = input(mesh);
    for (const BoundaryRule boundary : {BoundaryRule::Fixed, BoundaryRule::Slide}) {
      RunParameters parameters;
      parameters.interfaces = InterfaceRule::Slide;
      parameters.boundary = boundary;
      dmoscope::Run run = make_run(prepared, parameters);
      EXPECT_EQ(run.domain()->count_inside(), (n - 1) * (n - 1));
      Progress progress;
      run.iterate(6, progress);
      EXPECT_GT(slid(run), 10U);
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (v / ((n + 1) * (n + 1)) == n / 2) {
          ASSERT_EQ(run.positions()[v].z, 0.5) << "vertex " << v;
        }
    }
  }
}

/// Results have the same bits with any number of threads and any instructions, in one run or in steps, after going back, and with other
/// aims.
TEST(SlidingInSpaceBits, AreTheSame) {
  const Index n = 3;
  for (const Fill fill : {Fill::Hexahedra, Fill::Tetrahedra, Fill::Mixed}) {
    const auto mesh = input(mapped(shaken(volume_grid(n, fill, 0.3, 4), 0.1, 4), twisted));
    Progress progress;
    for (const int aims : {0, 1, 2}) {
      RunParameters parameters = sliding_by();
      if (aims == 1) parameters.then_mean = PhaseBegin{.patience = 2};
      if (aims == 2) parameters.combination = CompositeTerms{0.3, Metric::ScaledJacobian};
      dmoscope::Run expected = make_run(mesh, parameters);
      expected.iterate(4, progress);
      const auto expect_same = [&](const dmoscope::Run& run, const char* what) {
        ASSERT_TRUE(same_bits(run.positions(), expected.positions())) << "aims " << aims << ": " << what;
      };
      for (const unsigned threads : {2U, 8U}) {
        dmoscope::Run run = make_run(mesh, parameters, threads);
        run.iterate(4, progress);
        expect_same(run, "threads");
      }
      for (const SimdLevel level : supported_simd_levels()) {
        RunParameters other = parameters;
        other.search.simd = level;
        dmoscope::Run run = make_run(mesh, other);
        run.iterate(4, progress);
        expect_same(run, "instructions");
      }
      dmoscope::Run stepped = make_run(mesh, parameters, 2);
      stepped.seek({2, stepped.visits_per_iteration() / 3}, progress);
      stepped.seek({4, 7 % stepped.visits_per_iteration()}, progress);
      stepped.seek({1, 0}, progress);
      stepped.seek({4, 0}, progress);
      expect_same(stepped, "seek");
    }
  }
}

}  // namespace
}  // namespace dmoscope
