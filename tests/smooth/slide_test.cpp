// Vertices that slide along the boundary: they never leave the input's, keep their order on it, deviate by no more than the bound, and
// gain. All by plain geometry against the input's edges.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/mesh/generate.h"
#include "core/numeric/simd.h"
#include "core/smooth/execution/method_table.h"
#include "tests/smooth/sliding.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

using namespace testing;
using ::testing::HasSubstr;

using Segment = std::pair<Index, Index>;

/// The edges of exactly one element, found by counting; or those between elements of the first group and others.
std::vector<Segment> boundary_edges(const Mesh& mesh, bool of_group = false) {
  std::map<Segment, int> count;
  std::vector<bool> in_group(mesh.elements.size(), false);
  if (of_group)
    for (const Index e : mesh.groups[0].members) in_group[e] = true;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    for (std::size_t i = 0; i < corners.size() && (!of_group || in_group[e]); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      ++count[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::vector<Segment> found;
  for (const auto& [edge, times] : count)
    if (times == 1) found.push_back(edge);
  return found;
}
double distance(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double t = dot(d, d) > 0.0 ? std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0) : 0.0;
  return length(p - (a + t * d));
}
double distance(Vec3 p, std::span<const Vec3> positions, const std::vector<Segment>& edges) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : edges) least = std::min(least, distance(p, positions[a], positions[b]));
  return least;
}

/// Maps a lattice on the unit square.
Mesh bent(Index n, double jitter, std::uint64_t seed, Cells cells, Vec3 (*map)(Vec3)) {
  return mapped(lattice(n, jitter, seed, cells), map);
}

/// A ring of quadrilaterals or triangles, round inside and outside.
Mesh ring(Index sectors, Index layers, std::uint64_t seed) {
  Mesh mesh;
  dmoscope::testing::Random random(seed);
  for (Index j = 0; j <= layers; ++j)
    for (Index i = 0; i < sectors; ++i) {
      const bool inside = j > 0 && j < layers;
      const double angle = 2 * M_PI * (i + random(-0.3, 0.3)) / sectors, radius = 1.0 + (j + (inside ? random(-0.3, 0.3) : 0.0)) / layers;
      mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  for (Index j = 0; j < layers; ++j)
    for (Index i = 0; i < sectors; ++i) {
      const Index a = j * sectors + i, b = j * sectors + (i + 1) % sectors, c = b + sectors, d = a + sectors;
      if (i % 3 == 0) {
        testing::add(mesh, {a, d, c, b});
      } else {
        testing::add(mesh, {a, d, c});
        testing::add(mesh, {a, c, b});
      }
    }
  return mesh;
}

std::vector<Specimen> specimens() {
  std::vector<Specimen> all;
  std::uint64_t seed = 40;
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    ++seed;
    all.push_back({"square", lattice(10, 0.45, seed, cells)});
    all.push_back({"square, tangled", lattice(10, 0.9, seed, cells)});
    all.push_back({"stretched", bent(10, 0.4, seed, cells, [](Vec3 p) { return Vec3{1000 * p.x * p.x * p.x, p.y, 0}; })});
    all.push_back({"waves", bent(14, 0.4, seed, cells, [](Vec3 p) { return Vec3{p.x, p.y + 0.1 * std::sin(5 * p.x), 0}; })});
    all.push_back({"steep, tangled", bent(14, 0.9, seed, cells, [](Vec3 p) { return Vec3{p.x, p.y * (1 + 2 * p.x * p.x * p.x), 0}; })});
    all.push_back({"tilted, far", bent(8, 0.4, seed, cells, [](Vec3 p) { return Vec3{1e6 + 0.6 * p.x, p.y - 1e6, 0.8 * p.x}; })});
    all.push_back({"tiny", bent(8, 0.4, seed, cells, [](Vec3 p) { return 1e-9 * p; })});
    Mesh single = bent(8, 0.4, seed, cells, [](Vec3 p) {
      return Vec3{static_cast<float>(p.x), static_cast<float>(p.y + 0.1 * p.x * p.x), 0};
    });
    single.single_precision = true;
    all.push_back({"single precision", std::move(single)});
  }
  all.push_back({"ring", ring(40, 3, 50)});
  all.push_back({"fine ring", ring(90, 2, 51)});
  Progress progress;
  for (const std::uint64_t s : {1U, 2U, 3U}) all.push_back({"coast", generate_mesh("coast", 400, s, progress)});
  all.push_back({"random", generate_mesh("random", 300, 5, progress)});
  return all;
}

/// Expects the properties of any sliding.
void expect_on_the_boundary(const Specimen& specimen, const dmoscope::Run& run, const std::vector<Segment>& edges, double max_deviation) {
  const InputMesh& mesh = run.input();
  const std::span<const Vec3> before = mesh.mesh.positions, now = run.positions();
  const double size = mesh.geometry.size, rounding = mesh.mesh.single_precision ? 4e-7 : 1e-12;
  double far = 0.0;
  for (const Vec3& p : before) far = std::max({far, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double tolerance = rounding * std::max(size, mesh.mesh.single_precision ? far : 4e-4 * far);
  const double bound = max_deviation * size + tolerance;
  for (Index v = 0; v < now.size(); ++v) {
    if (mesh.topology.boundary()[v] == 0) continue;
    ASSERT_LE(distance(now[v], before, edges), tolerance) << specimen.name << ": vertex " << v << " left the boundary";
    if (run.domain()->slides(v)) continue;
    ASSERT_TRUE(same_bits(now.subspan(v, 1), before.subspan(v, 1))) << specimen.name << ": corner " << v;
  }
  for (const auto& [a, b] : edges)
    for (const double t : {0.1, 0.25, 0.5, 0.65, 0.9}) {
      ASSERT_LE(distance(now[a] + t * (now[b] - now[a]), before, edges), bound) << specimen.name << ": edge " << a << ' ' << b;
      ASSERT_LE(distance(before[a] + t * (before[b] - before[a]), now, edges), bound)
          << specimen.name << ": the input at " << a << ' ' << b;
    }
}

class Sliding : public ::testing::TestWithParam<Metric> {};

TEST_P(Sliding, KeepsItsPromisesAfterEveryIteration) {
  std::size_t moved = 0;
  for (const Specimen& specimen : specimens()) {
    if (!defined_for_all(GetParam(), specimen.mesh)) continue;
    const auto mesh = input(specimen.mesh);
    const auto edges = boundary_edges(mesh->mesh);
    for (const double bound : {1e-3, 0.05}) {
      RunParameters parameters = sliding_by(bound);
      parameters.metric = GetParam();
      dmoscope::Run run = make_run(mesh, parameters);
      ASSERT_NE(run.domain(), nullptr);
      for (std::uint64_t iteration = 1; iteration <= (kSanitized ? 3 : 6); ++iteration) {
        expect_promise_one(specimen, run, iteration);
        expect_on_the_boundary(specimen, run, edges, bound);
        expect_in_order(specimen, run);
        if (::testing::Test::HasFatalFailure()) return;
      }
      moved += slid(run);
    }
  }
  EXPECT_GT(moved, 200U);
}

TEST(SlidingByOthers, KeepTheirPromisesAfterEveryIteration) {
  for (const char* method : {"smart-laplace", "pattern-search", "laplace", "dvr", "active-set", "angle-based"}) {
    std::size_t moved = 0;
    for (const Specimen& specimen : specimens()) {
      const auto mesh = input(specimen.mesh);
      const auto edges = boundary_edges(mesh->mesh);
      RunParameters parameters = sliding_by();
      parameters.method = method;
      dmoscope::Run run = make_run(mesh, parameters);
      for (std::uint64_t iteration = 1; iteration <= 3; ++iteration) {
        expect_promise_one_if(method_info(method).optimises, specimen, run, iteration);
        expect_on_the_boundary(specimen, run, edges, 1e-3);
        expect_in_order(specimen, run);
        if (::testing::Test::HasFatalFailure()) return;
      }
      moved += slid(run);
    }
    EXPECT_GT(moved, 100U) << method;
  }
}

/// Each cluster of joint moves may move many sliding vertices.
TEST(SlidingTogether, KeepsItsPromisesAfterEveryCluster) {
  std::size_t moved = 0;
  for (const Specimen& specimen : specimens()) {
    const auto mesh = input(specimen.mesh);
    const auto edges = boundary_edges(mesh->mesh);
    for (const double bound : {1e-3, 0.05}) {
      RunParameters parameters = sliding_by(bound);
      parameters.method = "joint";
      dmoscope::Run run = make_run(mesh, parameters);
      for (std::uint64_t iteration = 1; iteration <= (kSanitized ? 2 : 4); ++iteration) {
        expect_promise_one(specimen, run, iteration);
        expect_on_the_boundary(specimen, run, edges, bound);
        expect_in_order(specimen, run);
        if (::testing::Test::HasFatalFailure()) return;
      }
      moved += slid(run);
    }
  }
  EXPECT_GT(moved, 500U);
}

/// A square whose optimum is known: all vertices as in a lattice. Those of its sides are moved along these, those inside anywhere.
TEST(SlidingTogether, FindsTheLattice) {
  for (const double scale : {1e-9, 1.0, 1e6}) {
    constexpr Index n = 6;
    Mesh mesh = lattice(n, 0.0, 1, Cells::Quadrilaterals);
    testing::Random random(7);
    for (Vec3& p : mesh.positions) {
      const double room = 0.3 / n;
      if (p.x > 0.0 && p.x < 1.0) p.x += random(-room, room);
      if (p.y > 0.0 && p.y < 1.0) p.y += random(-room, room);
      p = scale * p;
    }
    const auto prepared = input(mesh);
    RunParameters fixed, slides = sliding_by();
    fixed.method = slides.method = "joint";
    Progress progress;
    dmoscope::Run held = make_run(prepared, fixed), free = make_run(prepared, slides);
    held.until_converged({}, progress);
    const Outcome outcome = free.until_converged({}, progress);
    EXPECT_LT(held.statistics().minimum, 0.95) << scale;
    EXPECT_GT(free.statistics().minimum, 0.9995) << scale;
    EXPECT_EQ(outcome.reason, StopReason::Certified) << scale << ": " << outcome.sentence();
  }
}

/// A boundary that turns by 15 degrees, with the turn as the best place of a vertex: sliding must end there, with a certificate.
TEST(SlidingTogether, ACornerOfTheCurveHoldsAVertex) {
  const double slope = std::tan(7.5 * M_PI / 180.0);
  const auto on_roof = [slope](double x) { return Vec3{x, -slope * std::abs(x), 0}; };
  // Beneath the ridge lies a triangle that would be better higher, and worse on either side.
  Mesh mesh;
  mesh.positions = {on_roof(-0.6), {-0.5, -0.3, 0}, {0.5, -0.3, 0}, on_roof(0.6), on_roof(0.0)};
  testing::add(mesh, {0, 1, 4});
  testing::add(mesh, {1, 2, 4});
  testing::add(mesh, {2, 3, 4});
  const auto prepared = input(mesh);
  RunParameters parameters = sliding_by(1.0);
  parameters.method = "joint";
  const dmoscope::Run run = make_run(prepared, parameters);
  ASSERT_TRUE(run.domain()->slides(4));
  std::vector<Vec3> positions(mesh.positions);
  const auto least = [&](Vec3 ridge) {
    positions[4] = ridge;
    return compute_statistics(prepared->quality_context(), positions, Metric::MeanRatio, run.immovable(), nullptr).minimum;
  };
  const double best = least(on_roof(0.0));
  for (const double x : {-0.1, -0.01, -0.001, 0.001, 0.01, 0.1}) ASSERT_LT(least(on_roof(x)), best - 0.01 * std::abs(x)) << x;
  for (const double begin : {-0.25, 0.0, 0.15}) {
    JointClusters clusters(*prepared, Metric::MeanRatio, run.fixed(), {run.domain(), 1.0});
    positions[4] = on_roof(begin);
    JointState state;
    Progress progress;
    const auto cluster = clusters.raise_worst(positions, state, {}, progress);
    ASSERT_TRUE(cluster) << begin;
    EXPECT_NEAR(positions[4].x, 0.0, 1e-12) << begin;
    EXPECT_TRUE(cluster->certified) << begin << ": " << cluster->why_not;
  }
}

/// The result exceeds that of single sliding vertices, and that of joint moves with a fixed boundary.
TEST(SlidingTogether, ReachesMoreThanEitherAlone) {
  const Mesh mesh = bent(14, 0.4, 41, Cells::Triangles, [](Vec3 p) { return Vec3{p.x, p.y + 0.1 * std::sin(5 * p.x), 0}; });
  const auto prepared = input(mesh);
  Progress progress;
  const auto reached = [&](BoundaryRule boundary, bool joint) {
    RunParameters parameters = sliding_by();
    parameters.boundary = boundary;
    if (joint) parameters.then_joint.emplace();
    dmoscope::Run run = make_run(prepared, parameters);
    run.until_converged({.patience = 50}, progress);
    return run.statistics().minimum;
  };
  const double both = reached(BoundaryRule::Slide, true);
  EXPECT_GT(both, reached(BoundaryRule::Fixed, true) + 0.02);
  EXPECT_GT(both, reached(BoundaryRule::Slide, false) + 0.0005);
}

TEST(SlidingTogether, SameBitsForAnyNumberOfThreads) {
  const auto prepared = input(bent(14, 0.4, 41, Cells::Mixed, [](Vec3 p) { return Vec3{p.x, p.y + 0.1 * std::sin(5 * p.x), 0}; }));
  RunParameters parameters = sliding_by();
  parameters.method = "joint";
  Progress progress;
  std::vector<Vec3> first;
  for (const unsigned threads : {1U, 2U, 3U}) {
    dmoscope::Run run = make_run(prepared, parameters, threads);
    run.iterate(4, progress);
    if (first.empty()) first.assign(run.positions().begin(), run.positions().end());
    EXPECT_GT(slid(run), 10U);
    EXPECT_TRUE(same_bits(run.positions(), std::span<const Vec3>(first))) << threads;
  }
}

/// On a straight side the mean of two neighbours is the middle between them.
TEST(SlidingByOthers, LaplaceGoesToTheMiddle) {
  const Mesh start = lattice(4, 0.3, 9);
  RunParameters parameters = sliding_by(1.0);
  parameters.method = "laplace";
  parameters.options.relaxation = 0.25;
  dmoscope::Run run = make_run(input(start), parameters);
  Progress progress;
  std::vector<Vec3> before(start.positions);
  while (run.moment().iteration < 1) {
    const Index v = run.colouring().order[run.moment().visits];
    run.step(StepUnit::Vertex, progress);
    if (v > 0 && v < 4) {
      EXPECT_NEAR(run.positions()[v].x, 0.75 * before[v].x + 0.125 * (before[v - 1].x + before[v + 1].x), 1e-15);
      EXPECT_EQ(run.positions()[v].y, 0.0);
    }
    before.assign(run.positions().begin(), run.positions().end());
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, Sliding,
                         ::testing::Values(Metric::MeanRatio, Metric::MinAngle, Metric::ScaledJacobian, Metric::Rectangularity),
                         [](const auto& tested) {
                           std::string name(dmoscope::info(tested.param).name);
                           std::erase(name, '-');
                           return name;
                         });

/// Elements that are bad at a fixed boundary become good if it slides: its vertices crowd two by two.
TEST(SlidingGains, WhatTheBoundaryHolds) {
  Mesh mesh = lattice(8, 0.0, 3, Cells::Quadrilaterals);
  for (Index i = 1; i < 8; ++i) mesh.positions[i].x += (i % 2 == 0 ? -0.45 : 0.45) / 8;
  const auto prepared = input(mesh);
  Progress progress;
  dmoscope::Run held = make_run(prepared, {}), free = make_run(prepared, sliding_by());
  held.iterate(50, progress);
  free.iterate(50, progress);
  EXPECT_LT(held.statistics().minimum, 0.3);
  EXPECT_GT(free.statistics().minimum, 0.95);
}

/// Interfaces between materials, straight and curved, with a boundary that stays or slides.
TEST(SlidingInside, InterfacesStayWhereTheyAre) {
  std::vector<Specimen> all;
  Progress progress;
  for (const std::uint64_t seed : {1U, 2U}) all.push_back({"nested", generate_mesh("nested", 400, seed, progress)});
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals}) {
    constexpr Index n = 12;
    Mesh mesh = bent(n, 0.4, 60, cells, [](Vec3 p) { return Vec3{p.x, p.y, 0}; });
    for (Index v = 0; v < mesh.vertex_count(); ++v)  // the lattice's middle row lies on a curve, and is crowded there
      if (v / (n + 1) == n / 2)
        mesh.positions[v] = {std::pow((v % (n + 1)) / 12.0, 1.3), 0.5 + 0.02 * std::sin(3.0 * std::pow((v % (n + 1)) / 12.0, 1.3)), 0};
    Group lower{.name = "lower", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
    for (Index e = 0; e < mesh.elements.size(); ++e)
      if (e < mesh.elements.size() / 2) lower.members.push_back(e);
    mesh.groups = {lower};
    all.push_back({"curved", mesh});
  }
  std::size_t moved = 0;
  for (const Specimen& specimen : all) {
    const auto mesh = input(specimen.mesh);
    const auto edges = boundary_edges(mesh->mesh, true);
    std::vector<Segment> inner;  // edges of the group that are not the mesh's boundary
    for (const auto& edge : edges)
      if (mesh->topology.boundary()[edge.first] == 0 || mesh->topology.boundary()[edge.second] == 0) inner.push_back(edge);
    for (const auto& [boundary, method] : {std::pair{BoundaryRule::Fixed, "dmo"},
                                           {BoundaryRule::Slide, "dmo"},
                                           {BoundaryRule::Fixed, "joint"},
                                           {BoundaryRule::Slide, "joint"}}) {
      RunParameters parameters;
      parameters.method = method;
      parameters.interfaces = InterfaceRule::Slide;
      parameters.boundary = boundary;
      dmoscope::Run run = make_run(mesh, parameters);
      EXPECT_GT(run.domain()->count_inside(), 0U) << specimen.name;
      for (std::uint64_t iteration = 1; iteration <= 6; ++iteration) {
        expect_promise_one(specimen, run, iteration);
        expect_in_order(specimen, run);
        const std::span<const Vec3> before = mesh->mesh.positions, now = run.positions();
        const double size = mesh->geometry.size;
        for (const auto& [a, b] : inner) {
          for (const Index v : {a, b}) {
            const double way = mesh->topology.boundary()[v] == 0 ? distance(now[v], before, edges) : 0.0;
            ASSERT_LE(way, 1e-12 * size) << specimen.name << ": vertex " << v;
          }
          for (const double t : {0.25, 0.5, 0.75}) {
            ASSERT_LE(distance(now[a] + t * (now[b] - now[a]), before, edges), 1.0001e-3 * size) << specimen.name;
            ASSERT_LE(distance(before[a] + t * (before[b] - before[a]), now, edges), 1.0001e-3 * size) << specimen.name;
          }
        }
      }
      moved += slid(run);
    }
  }
  EXPECT_GT(moved, 50U);
}

/// Results have the same bits with any number of threads and any instructions, in one run or in steps, after going back, and with other
/// aims.
TEST(SlidingBits, AreTheSame) {
  for (const Specimen& specimen : specimens()) {
    const auto mesh = input(specimen.mesh);
    Progress progress;
    for (const int aims : {0, 1, 2}) {
      RunParameters parameters = sliding_by();
      if (aims == 1) parameters.then_mean = PhaseBegin{.patience = 2};
      if (aims == 2) parameters.combination = CompositeTerms{0.3, Metric::MinAngle};
      if (aims == 2 && !defined_for_all(Metric::MinAngle, specimen.mesh)) continue;
      dmoscope::Run expected = make_run(mesh, parameters);
      expected.iterate(5, progress);
      const auto expect_same = [&](const dmoscope::Run& run, const char* what) {
        ASSERT_TRUE(same_bits(run.positions(), expected.positions())) << specimen.name << ", aims " << aims << ": " << what;
      };
      for (const unsigned threads : {2U, 8U}) {
        dmoscope::Run run = make_run(mesh, parameters, threads);
        run.iterate(5, progress);
        expect_same(run, "threads");
      }
      for (const SimdLevel level : supported_simd_levels()) {
        RunParameters other = parameters;
        other.search.simd = level;
        dmoscope::Run run = make_run(mesh, other);
        run.iterate(5, progress);
        expect_same(run, "instructions");
      }
      dmoscope::Run stepped = make_run(mesh, parameters, 2);
      stepped.seek({2, stepped.visits_per_iteration() / 3}, progress);
      stepped.seek({5, 7 % stepped.visits_per_iteration()}, progress);
      stepped.seek({1, 0}, progress);
      stepped.seek({5, 0}, progress);
      expect_same(stepped, "seek");
    }
  }
}

/// If neighbours are outside, on the wrong side of the boundary, elements would turn over if its vertices changed places.
TEST(SlidingChoice, NobodyGoesPastANeighbour) {
  for (const std::uint64_t seed : {5U, 6U, 7U, 8U}) {
    Mesh mesh = lattice(9, 0.3, seed);
    RunParameters parameters = sliding_by(1.0);
    for (Index v = 10; v < 20; ++v) {
      if (v % 10 == 0 || v % 10 == 9) continue;
      mesh.positions[v].y = -mesh.positions[v].y;
      parameters.fixed.push_back(v);
    }
    const Specimen specimen{"outside", mesh};
    dmoscope::Run run = make_run(input(mesh), parameters);
    Progress progress;
    for (int i = 0; i < 10; ++i) {
      run.iterate(1, progress);
      expect_in_order(specimen, run);
      for (Index v = 1; v <= 9; ++v) ASSERT_LT(run.positions()[v - 1].x, run.positions()[v].x) << "seed " << seed << ", iteration " << i;
    }
  }
}

TEST(SlidingRefusals, AreSaid) {
  const auto expect_refused = [](const std::shared_ptr<const InputMesh>& mesh, const RunParameters& parameters, const char* why) {
    try {
      (void)make_run(mesh, parameters);
      ADD_FAILURE() << why;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  Progress progress;
  expect_refused(input(generate_mesh("globe", 300, 1, progress)), sliding_by(), "longitude");
}

/// Vertices that the user fixes stay, also on a curve, and the others slide between them.
TEST(SlidingChoice, AFixedVertexStays) {
  const auto mesh = input(lattice(8, 0.45, 4));
  RunParameters parameters = sliding_by();
  parameters.fixed = {4};
  dmoscope::Run run = make_run(mesh, parameters);
  Progress progress;
  run.iterate(10, progress);
  EXPECT_TRUE(same_bits(run.positions().subspan(4, 1), std::span(mesh->mesh.positions).subspan(4, 1)));
  EXPECT_LT(run.positions()[3].x, run.positions()[4].x);
  EXPECT_GT(run.positions()[5].x, run.positions()[4].x);
}

}  // namespace
}  // namespace dmoscope
