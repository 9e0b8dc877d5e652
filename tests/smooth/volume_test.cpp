// Volumes: the promises on every kind of element, by every method that smooths them, and results on real meshes.

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/input/input_mesh.h"
#include "core/mesh/generate.h"
#include "core/mesh/random.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/methods/dvr.h"
#include "tests/smooth/promises.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using testing::expect_fixed_stay;
using testing::expect_promise_one;
using testing::input;
using testing::kBudget;
using testing::make_run;
using testing::Specimen;

/// Small cubes of every kind of element, sound and with vertices thrown far out of place.
std::vector<Specimen> volumes() {
  std::vector<Specimen> all;
  Progress progress;
  for (const char* kind : {"tetrahedra", "hexahedra", "solids"}) {
    const Mesh mesh = generate_mesh(kind, 216, 5, progress);
    all.push_back({kind, mesh});
    Mesh tangled = mesh;
    dmoscope::Random random(6);
    const auto free = input(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (free->topology.boundary()[v] == 0 && random.below(4) == 0)
        tangled.positions[v] = tangled.positions[v] + Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    all.push_back({std::string(kind) + ", tangled", tangled});
    Mesh far = mesh;
    for (Vec3& p : far.positions) p = p + Vec3{1e6, -1e6, 1e6};
    all.push_back({std::string(kind) + ", far", far});
    Mesh single = mesh;
    for (Vec3& p : single.positions) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    single.single_precision = true;
    all.push_back({std::string(kind) + ", single precision", single});
  }
  return all;
}

class VolumePromises : public ::testing::TestWithParam<const char*> {};

TEST_P(VolumePromises, NoVisitMakesAnythingWorseAndFixedVerticesKeepTheirBits) {
  for (const Specimen& specimen : volumes()) {
    for (const Metric metric : {Metric::MeanRatio, Metric::Condition, Metric::RadiusRatio}) {
      if (!testing::defined_for_all(metric, specimen.mesh)) continue;
      RunParameters parameters;
      parameters.method = GetParam();
      parameters.metric = metric;
      parameters.fixed = {43, 44};  // inside
      dmoscope::Run run = make_run(input(specimen.mesh), parameters);
      expect_promise_one(specimen, run, 2);
      expect_fixed_stay(specimen, run);
      EXPECT_GT(run.history().records()[1].moved, 0U) << specimen.name;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Volumes, VolumePromises, ::testing::Values("dmo", "smart-laplace", "pattern-search", "dvr", "active-set"),
                         [](const auto& test) {
                           std::string text = test.param;
                           std::ranges::replace(text, '-', '_');
                           return text;
                         });

/// A regular octahedron or icosahedron, each of whose faces makes a tetrahedron with the hub, displaced from the middle; the hub is the
/// last.
Mesh star_of_tetrahedra(bool icosahedron, Vec3 hub) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> rim;
  for (const double one : {-1.0, 1.0}) {
    if (!icosahedron) {
      rim.insert(rim.end(), {{one, 0, 0}, {0, one, 0}, {0, 0, one}});
      continue;
    }
    for (const double other : {-golden, golden}) rim.insert(rim.end(), {{0, one, other}, {one, other, 0}, {other, 0, one}});
  }
  const double edge = icosahedron ? 2.0 : std::sqrt(2.0);
  const auto apart = [&](Index a, Index b) { return std::abs(length(rim[a] - rim[b]) - edge) < 1e-9; };
  Mesh mesh;
  const auto n = static_cast<Index>(rim.size());
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b)
      for (Index c = b + 1; c < n; ++c) {
        if (!apart(a, b) || !apart(b, c) || !apart(c, a)) continue;
        const bool outward = dot(cross(rim[b] - rim[a], rim[c] - rim[a]), rim[a]) > 0.0;
        mesh.elements.add(ElementKind::Tetrahedron, std::array{n, a, outward ? b : c, outward ? c : b});
      }
  mesh.positions = std::move(rim);
  mesh.positions.push_back(hub);
  return mesh;
}

TEST(Volume, TheHubOfARegularStarGoesBackToItsMiddle) {
  for (const bool icosahedron : {false, true}) {
    const auto mesh = input(star_of_tetrahedra(icosahedron, {0.2, -0.11, 0.15}));
    ASSERT_EQ(mesh->mesh.elements.size(), icosahedron ? 20U : 8U);
    const Index hub = mesh->mesh.vertex_count() - 1;
    Progress progress;
    for (const Metric metric : {Metric::MeanRatio, Metric::RadiusRatio, Metric::Condition}) {
      dmoscope::Run ascent = make_run(mesh, {.method = "active-set", .metric = metric});
      ascent.iterate(10, progress);
      // Values within 3e-5 of the least count as the least.
      EXPECT_LT(length(ascent.positions()[hub]), 1e-3) << icosahedron << ' ' << info(metric).name;
    }
    for (const Directions directions : {Directions::Random, Directions::Axes}) {
      dmoscope::Run lines = make_run(mesh, {.method = "dvr", .options = {.directions = directions}});
      lines.iterate(60, progress);
      EXPECT_LT(length(lines.positions()[hub]), 1e-2) << icosahedron << ' ' << name(directions);
    }
  }
}

/// Eight hexahedra about a vertex; the outermost corner of one is the worst of all, and no move can mend it.
TEST(Volume, ACornerThatAVertexDoesNotChangeDoesNotHoldIt) {
  Mesh mesh = test::volume_grid(2, test::Fill::Hexahedra);
  const Index hub = 13, across = 26;
  const Vec3 middle{0.5, 0.5, 0.5};
  mesh.positions[hub] = middle + Vec3{0.09, -0.06, 0.07};
  mesh.positions[across] = {0.85, 0.85, 0.85};
  const auto mesh_input = input(mesh);
  const double worst = make_run(mesh_input, {}).statistics().minimum;
  EXPECT_LT(worst, 0.35);
  for (const char* method : {"dmo", "smart-laplace", "pattern-search", "dvr", "active-set"})
    for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian, Metric::Condition})
      for (const Precision precision : {Precision::Float, Precision::Double}) {
        if (method == std::string_view("dvr") && metric != Metric::MeanRatio) continue;  // dvr has the mean ratio alone
        dmoscope::Run run = make_run(mesh_input, {.method = method, .metric = metric, .search = {.precision = precision}});
        const double before = run.statistics().minimum;
        Progress progress;
        run.iterate(60, progress);
        // All eight corners change alike.
        EXPECT_LT(length(run.positions()[hub] - middle), 0.01) << method << ' ' << info(metric).name;
        EXPECT_EQ(run.statistics().minimum, before);
      }
}

TEST(Volume, LaplaceGoesToTheMeanOfTheEdgeNeighboursEachOnce) {
  // An octahedron's hub, one of whose eight tetrahedra is split into three: its seven neighbours are in three to five of them.
  Mesh mesh = star_of_tetrahedra(false, {0.1, 0.05, -0.07});
  const Index hub = mesh.vertex_count() - 1, split = mesh.vertex_count();
  const std::vector<Index> one(mesh.elements.corners(0).begin(), mesh.elements.corners(0).end());
  Mesh uneven;
  uneven.positions = mesh.positions;
  uneven.positions.push_back((1.0 / 3.0) * (mesh.positions[one[1]] + mesh.positions[one[2]] + mesh.positions[one[3]]));
  for (std::size_t left = 1; left < 4; ++left) {
    std::vector<Index> part = one;
    part[left] = split;
    uneven.elements.add(ElementKind::Tetrahedron, part);
  }
  for (Index e = 1; e < mesh.elements.size(); ++e) uneven.elements.add(ElementKind::Tetrahedron, mesh.elements.corners(e));
  Vec3 mean{};
  for (Index v = 0; v < uneven.vertex_count(); ++v)
    if (v != hub) mean = mean + (1.0 / 7.0) * uneven.positions[v];
  dmoscope::Run run = make_run(input(uneven), {.method = "laplace"});
  ASSERT_EQ(run.visits_per_iteration(), 1U);
  Progress progress;
  run.step(StepUnit::Vertex, progress);
  EXPECT_LT(length(run.positions()[hub] - mean), 1e-15);
}

TEST(Volume, LaplaceInABlockOfHexahedraLooksAlongTheEdges) {
  Mesh mesh = test::volume_grid(2, test::Fill::Hexahedra);
  const Index hub = 13;
  mesh.positions[hub] = {0.6, 0.45, 0.5};
  mesh.positions[hub + 1] = {1.0, 0.7, 0.6};   // beside it
  mesh.positions[hub + 4] = {1.0, 1.1, 0.5};   // across a face
  mesh.positions[hub + 13] = {1.0, 1.0, 1.2};  // across a cell
  Vec3 mean{};
  for (const Index v : {hub - 1, hub + 1, hub - 3, hub + 3, hub - 9, hub + 9}) mean = mean + (1.0 / 6.0) * mesh.positions[v];
  dmoscope::Run run = make_run(input(mesh), {.method = "laplace"});
  Progress progress;
  run.step(StepUnit::Vertex, progress);
  EXPECT_LT(length(run.positions()[hub] - mean), 1e-15);
}

/// Values of places on a line for the vertex at 0. The least Jacobian of a tangled star must not fall, and rises if it untangles; if there
/// is a sound place anywhere on the line, only sound ones count.
class LineOfPlaces {
 public:
  LineOfPlaces(const InputMesh& mesh, std::vector<Vec3> positions, Index hub, Vec3 d)
      : mesh_(mesh), positions_(std::move(positions)), hub_(hub), old_(positions_[hub]), d_(d), here_(state(0.0)) {
    for (const double t : samples()) sound_ = sound_ || state(t).jacobian > 0.0;
  }
  [[nodiscard]] bool is_tangled() const { return !(here_.jacobian > 0.0); }
  [[nodiscard]] bool can_be_sound() const { return sound_; }
  [[nodiscard]] double worth(double t) {
    const StarState at = state(t);
    if (sound_) return at.jacobian > 0.0 ? at.quality : -1.0;
    return at.jacobian >= here_.jacobian ? at.untangling : -HUGE_VAL;
  }
  [[nodiscard]] static std::vector<double> samples() {
    constexpr int kSamples = 2000;
    std::vector<double> all;
    for (int i = -kSamples; i <= kSamples; ++i) all.push_back(0.5 * i / kSamples);
    return all;
  }

 private:
  [[nodiscard]] StarState state(double t) {
    positions_[hub_] = old_ + t * d_;
    return star_state(mesh_, positions_, Metric::MeanRatio, hub_);
  }
  const InputMesh& mesh_;
  std::vector<Vec3> positions_;
  Index hub_;
  Vec3 old_, d_;
  StarState here_;
  bool sound_ = false;
};

/// Results of visits of dvr to tangled stars.
struct OnLines {
  std::size_t made_sound = 0, less_tangled = 0, refused = 0;
};

/// Makes the next visits of dvr, of the first class, and expects the best places on their lines.
void expect_best_on_lines(dmoscope::Run& run, const std::string& what, OnLines& count) {
  const bool repair = run.sweep().untangling.repair;
  const Vec3 d = volume_dvr_direction(run.parameters().options, run.moment().iteration);
  Progress progress;
  for (const Index hub : run.colouring().members(0)) {
    const Vec3 old = run.positions()[hub];
    LineOfPlaces line(run.input(), {run.positions().begin(), run.positions().end()}, hub, d);
    run.visit_vertices(std::array{hub}, progress);  // an iteration of a tangled mesh would move them together
    const Vec3 way = run.positions()[hub] - old;
    EXPECT_LT(length(cross(way, d)), 1e-14) << what << ": off the line";
    if (repair && !line.is_tangled()) {  // waits for the repair
      EXPECT_EQ(way, Vec3{}) << what;
      continue;
    }
    if (line.is_tangled() && way == Vec3{}) {  // the best place would invert more, or lower the mesh's minimum, or is no repair
      count.refused += repair ? 0 : 1;
      continue;
    }
    const double found = line.worth(dot(way, d));
    for (const double t : LineOfPlaces::samples()) EXPECT_GE(found, line.worth(t) - 1e-8) << what << ": hub " << hub << ", " << t;
    if (line.is_tangled() && found > line.worth(0.0)) ++(line.can_be_sound() ? count.made_sound : count.less_tangled);
  }
}

TEST(Volume, DvrFindsTheBestPlaceOnItsLineInEveryKindOfElement) {
  OnLines count;
  for (const Specimen& specimen : volumes()) {
    if (specimen.name.find(',') != std::string::npos && !specimen.name.ends_with("tangled")) continue;
    for (const std::uint64_t seed : {3U, 4U}) {
      dmoscope::Run run = make_run(input(specimen.mesh), {.method = "dvr", .options = {.seed = seed}});
      const bool repair = run.sweep().untangling.repair;
      expect_best_on_lines(run, specimen.name, count);
      if (!repair) continue;
      Progress progress;
      while (run.sweep().untangling.repair) run.step(StepUnit::Iteration, progress);
      expect_best_on_lines(run, specimen.name + ", after repairs", count);
    }
  }
  EXPECT_GE(count.made_sound, 5U);
  EXPECT_GE(count.less_tangled, 1U);
  EXPECT_LT(count.refused, 25U);
}

TEST(Volume, DvrDirectionsAreOfLengthOneAndGoEverywhereAlike) {
  double squares[3] = {};
  constexpr int kCount = 4000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const Vec3 d = volume_dvr_direction({.seed = 5}, i);
    EXPECT_NEAR(length(d), 1.0, 1e-15);
    EXPECT_EQ(d, volume_dvr_direction({.seed = 5}, i));
    squares[0] += d.x * d.x, squares[1] += d.y * d.y, squares[2] += d.z * d.z;
  }
  for (const double sum : squares) EXPECT_NEAR(sum / kCount, 1.0 / 3.0, 0.02);
  const MethodOptions axes{.directions = Directions::Axes};
  EXPECT_EQ(volume_dvr_direction(axes, 3), (Vec3{1, 0, 0}));
  EXPECT_EQ(volume_dvr_direction(axes, 4), (Vec3{0, 1, 0}));
  EXPECT_EQ(volume_dvr_direction(axes, 5), (Vec3{0, 0, 1}));
  EXPECT_EQ(still_iterations(method_info("dvr"), axes, true), 3U);
  EXPECT_EQ(still_iterations(method_info("dvr"), axes, false), 2U);
}

TEST(Volume, SameBitsForAnyThreadsAndSteps) {
  for (const Specimen& specimen : volumes()) {
    const auto mesh = input(specimen.mesh);
    Progress progress;
    dmoscope::Run one = make_run(mesh, {}, 1), three = make_run(mesh, {}, 3), by_vertex = make_run(mesh, {}, 1);
    one.iterate(2, progress);
    three.iterate(2, progress);
    while (by_vertex.moment().iteration < 2) by_vertex.step(StepUnit::Vertex, progress);
    EXPECT_TRUE(same_bits(one.positions(), three.positions())) << specimen.name;
    EXPECT_TRUE(same_bits(one.positions(), by_vertex.positions())) << specimen.name;
  }
}

TEST(Volume, SameBitsForAnyThreadsWhereClassesAreLarge) {
  Progress progress;
  const auto mesh = input(generate_mesh("tetrahedra", 8000, 5, progress));
  for (const char* method : {"dmo", "smart-laplace"}) {
    dmoscope::Run one = make_run(mesh, {.method = method}, 1), three = make_run(mesh, {.method = method}, 3);
    ASSERT_GT(one.colouring().members(0).size(), 512U) << "or there is nothing to share";
    one.iterate(2, progress);
    three.iterate(2, progress);
    EXPECT_TRUE(same_bits(one.positions(), three.positions())) << method;
  }
}

/// Least value over all corners of all elements, from the elements themselves.
double least_normalised_jacobian(const InputMesh& mesh, std::span<const Vec3> positions) {
  double least = HUGE_VAL;
  for (Index e = 0; e < mesh.mesh.elements.size(); ++e)
    least = std::min(least, smallest_jacobian(mesh.quality_context(), positions, e) / mesh.reference_measure[e]);
  return least;
}

TEST(Volume, InAnAttemptToUntangleTheLeastJacobianNeverFalls) {
  for (const Specimen& specimen : volumes()) {
    if (specimen.name.find("tangled") == std::string::npos) continue;
    for (const char* method : {"dmo", "smart-laplace", "pattern-search"}) {
      const auto mesh = input(specimen.mesh);
      Progress progress;
      dmoscope::Run run = make_run(mesh, {.method = method});
      double before = least_normalised_jacobian(*mesh, run.positions());
      ASSERT_LT(before, 0.0);
      while (run.moment().iteration < 5) {
        const bool attempt = run.sweep().untangling.attempt;
        run.step(StepUnit::Class, progress);
        const double after = least_normalised_jacobian(*mesh, run.positions());
        if (before <= 0.0 && attempt) {
          EXPECT_GE(after, before) << specimen.name << ", " << method;
        }
        before = after;
      }
    }
  }
}

TEST(Volume, AnElementAndItsDuplicateHoldTheirBoundary) {
  Progress progress;
  Mesh mesh = generate_mesh("hexahedra", 64, 1, progress);
  const Mesh alone = mesh;
  mesh.elements.add(ElementKind::Hexahedron, std::vector<Index>(alone.elements.corners(0).begin(), alone.elements.corners(0).end()));
  const auto twice = input(mesh), once = input(alone);
  EXPECT_EQ(twice->report.duplicate_elements, std::vector<Index>{alone.elements.size()});
  EXPECT_EQ(twice->report.flipped_elements, 0U);
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_GE(twice->topology.boundary()[v], once->topology.boundary()[v]) << v;
}

TEST(Volume, SameBitsForAnyInstructions) {
  for (const Specimen& specimen : volumes()) {
    const auto mesh = input(specimen.mesh);
    for (const Metric metric : {Metric::MeanRatio, Metric::MinAngle, Metric::ScaledJacobian}) {
      if (!testing::defined_for_all(metric, specimen.mesh)) continue;
      for (const int points : {5, 8}) {
        const auto with = [&](SimdLevel level) {
          dmoscope::Run run = make_run(mesh, {.metric = metric, .search = {.grid_points = points, .simd = level}});
          Progress progress;
          run.iterate(points == 8 ? 2 : 1, progress);
          return std::vector<Vec3>(run.positions().begin(), run.positions().end());
        };
        const std::vector<Vec3> baseline = with(SimdLevel::Baseline);
        for (const SimdLevel level : supported_simd_levels()) {
          if (level == SimdLevel::Baseline) continue;
          EXPECT_TRUE(same_bits(with(level), baseline))
              << specimen.name << ", " << info(metric).name << ", " << name(level) << ", " << points;
        }
      }
    }
  }
}

/// Compares the fast search in float with the plain one in double: vertex by vertex from the same positions, the same candidate but for
/// ties within rounding.
TEST(Volume, TheFastSearchFindsWhatThePlainOneFinds) {
  for (const Specimen& specimen : volumes()) {
    const auto mesh = input(specimen.mesh);
    Progress progress;
    dmoscope::Run fast = make_run(mesh, {}), plain = make_run(mesh, {.search = {.precision = Precision::Double}});
    fast.step(StepUnit::Class, progress);
    plain.step(StepUnit::Class, progress);
    std::size_t same = 0, all = 0;
    for (const Index v : fast.colouring().members(0)) {
      const StarState a = star_state(*mesh, fast.positions(), Metric::MeanRatio, v),
                      b = star_state(*mesh, plain.positions(), Metric::MeanRatio, v);
      same += length(fast.positions()[v] - plain.positions()[v]) <= 1e-5 * mesh->geometry.size ? 1U : 0U;
      ++all;
      EXPECT_NEAR(a.quality, b.quality, 1e-4) << specimen.name << ", vertex " << v;
    }
    EXPECT_GE(same + all / 10, all) << specimen.name;
  }
}

TEST(Volume, NoTwoOfAClassShareAnElement) {
  for (const Specimen& specimen : volumes()) {
    const auto mesh = input(specimen.mesh);
    const dmoscope::Run run = make_run(mesh, {});
    std::vector<Index> colour(mesh->mesh.positions.size(), kNoIndex);
    for (Index c = 0; c < run.colouring().class_count(); ++c)
      for (const Index v : run.colouring().members(c)) colour[v] = c;
    for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
      std::vector<Index> seen;
      for (const Index v : mesh->mesh.elements.corners(e))
        if (colour[v] != kNoIndex) seen.push_back(colour[v]);
      std::ranges::sort(seen);
      EXPECT_EQ(std::ranges::adjacent_find(seen), seen.end()) << specimen.name << ", element " << e;
    }
  }
}

TEST(Volume, ACubeOfHexahedraBecomesPerfectWithTheSecondPhase) {
  Progress progress;
  const auto mesh = input(generate_mesh("hexahedra", 125, 3, progress));
  dmoscope::Run run = make_run(mesh, {.then_mean = PhaseBegin{}});
  run.iterate(60, progress);
  EXPECT_GT(run.statistics().minimum, 0.99) << "the lattice it was made from is worth 1";
}

/// Expects the same shape after smoothing in other units of length, which are no powers of two, but for rounding.
void expect_same_shape_in_any_unit(Mesh mesh, std::uint64_t iterations, const std::string& name) {
  mesh.single_precision = false;  // floats round differently in other units
  Progress progress;
  const auto smooth = [&](double scale) {
    Mesh scaled = mesh;
    for (Vec3& p : scaled.positions) p = scale * p;
    dmoscope::Run run = make_run(input(std::move(scaled)), {}, 2);
    run.iterate(iterations, progress);
    return std::vector<Vec3>(run.positions().begin(), run.positions().end());
  };
  const std::vector<Vec3> as_is = smooth(1.0);
  EXPECT_FALSE(same_bits(as_is, mesh.positions)) << name;
  const double size = input(mesh)->geometry.size;
  for (const double scale : {1e-5, 1e4}) {
    const std::vector<Vec3> other = smooth(scale);
    double largest = 0.0;
    for (std::size_t v = 0; v < other.size(); ++v) largest = std::max(largest, length((1.0 / scale) * other[v] - as_is[v]));
    EXPECT_LT(largest, 1e-9 * size) << name << ", " << scale;
  }
}

TEST(Volume, TheUnitOfLengthDoesNotMatter) {
  for (const Specimen& specimen : volumes())
    if (specimen.name.find(',') == std::string::npos) expect_same_shape_in_any_unit(specimen.mesh, 10, specimen.name);
}

TEST(Volume, WhatIsForPlanarMeshesAloneIsRefused) {
  Progress progress;
  const auto mesh = input(generate_mesh("tetrahedra", 64, 1, progress));
  EXPECT_THROW(make_run(mesh, {.method = "angle-based"}), UsageError);
  EXPECT_THROW(make_run(mesh, {.metric = Metric::Rectangularity}), UsageError);
}

/// Statistics of a real mesh, smoothed.
Statistics smoothed(const char* file, std::uint64_t iterations, bool then_mean = false) {
  const std::filesystem::path path = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes" / file;
  Progress progress;
  const auto mesh = load_input(path, Need::Smoothing, progress);
  dmoscope::Run run = make_run(mesh, {.then_mean = then_mean ? std::optional(PhaseBegin{}) : std::nullopt}, 2);
  Statistics before = run.statistics();
  for (std::uint64_t i = 0; i < iterations; ++i) {
    run.iterate(i + 1, progress);
    const Statistics after = run.statistics();
    EXPECT_GE(after.minimum, before.minimum) << file << ", iteration " << i + 1;
    EXPECT_LE(after.inverted, before.inverted) << file;
    before = after;
  }
  return before;
}
bool shared_meshes_are_here() { return std::filesystem::exists(std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes"); }

TEST(Volume, RealMeshesBecomeAsGoodAsTheirReferences) {
  if (!shared_meshes_are_here()) GTEST_SKIP() << "no shared meshes at " DMOSCOPE_SHARED_DIR;
  const Statistics tire = smoothed("tet/tire.vtk", 2);
  EXPECT_NEAR(tire.minimum, 0.1637, 1e-4) << "the ceiling that elements set whose corners are all fixed";
  EXPECT_GT(tire.movable_minimum, 0.2335);
  EXPECT_GT(smoothed("tet/cube-clip-5.vtk", 1).movable_minimum, 0.28);
  const Statistics tetrahedra = smoothed("tet/tet_4_tangled.vtk", 2);
  EXPECT_EQ(tetrahedra.inverted, 0U);
  EXPECT_GT(smoothed("tet/tet_4_tangled.vtk", 20).minimum, 0.6);
  EXPECT_EQ(smoothed("hex/hex_5_tangled.vtk", 20).inverted, 0U);
}

TEST(Volume, TheUnitOfLengthOfRealMeshesDoesNotMatter) {
  if (!shared_meshes_are_here()) GTEST_SKIP() << "no shared meshes at " DMOSCOPE_SHARED_DIR;
  Progress progress;
  for (const char* file : {"tet/tire.vtk", "hex/hex_5_tangled.vtk", "mixed3d/mixed-hex-pyr-tet.vtk"})
    expect_same_shape_in_any_unit(load_input(std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes" / file, Need::Smoothing, progress)->mesh,
                                  10, file);
}

}  // namespace
}  // namespace dmoscope
