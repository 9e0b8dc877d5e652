// Promise 1 on tangled meshes of every kind, for every method that optimises, by every metric, in shuffled orders, with both phases, and
// combined: no iteration raises the number of inverted elements or lowers the minimum. Counted by separate formulas.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/smooth/execution/method_table.h"
#include "tests/smooth/promises.h"
#include "tests/smooth/tangled_zoo.h"
#include "tests/support/inside.h"

namespace dmoscope {
namespace {

using test::Fill;
using testing::Cells;
using testing::input;
using testing::lattice;
using testing::make_run;
using testing::Spoiling;

double least_inside(ElementKind kind, std::span<const Index> v, std::span<const Vec3> at) {
  const double least = test::least_inside(kind, v, at);
  return std::abs(least) < 5e-3 ? test::least_inside(kind, v, at, 32) : least;
}
/// Counts elements with a corner whose edges span an area or volume of at most `limit`, or with such a place inside among 9^3, or 33^3 if
/// one of them is near to it, by a separate implementation.
Index count_below(const InputMesh& input, std::span<const Vec3> at, double limit) {
  const auto corner = [&](Index a, Index b, Index c) { return cross(at[b] - at[a], at[c] - at[a]).z; };
  const auto spat = [&](Index a, Index b, Index c, Index d) { return dot(cross(at[b] - at[a], at[c] - at[a]), at[d] - at[a]); };
  Index inverted = 0;
  const ElementTable& elements = input.mesh.elements;
  for (Index e = 0; e < elements.size(); ++e) {
    const auto v = elements.corners(e);
    double least = HUGE_VAL;
    switch (elements.kind(e)) {
      case ElementKind::Triangle:
        least = corner(v[0], v[1], v[2]);
        break;
      case ElementKind::Quadrilateral:
        for (std::size_t i = 0; i < 4; ++i) least = std::min(least, corner(v[i], v[(i + 1) % 4], v[(i + 3) % 4]));
        break;
      case ElementKind::Tetrahedron:
        least = spat(v[0], v[1], v[2], v[3]);
        break;
      case ElementKind::Hexahedron:
        least = least_inside(elements.kind(e), v, at);
        for (std::size_t i = 0; i < 4; ++i) {
          least = std::min(least, spat(v[i], v[(i + 1) % 4], v[(i + 3) % 4], v[i + 4]));
          least = std::min(least, spat(v[i + 4], v[(i + 3) % 4 + 4], v[(i + 1) % 4 + 4], v[i]));
        }
        break;
      case ElementKind::Wedge:
        least = least_inside(elements.kind(e), v, at);
        for (std::size_t i = 0; i < 3; ++i) {
          least = std::min(least, spat(v[i], v[(i + 1) % 3], v[(i + 2) % 3], v[i + 3]));
          least = std::min(least, spat(v[i + 3], v[(i + 2) % 3 + 3], v[(i + 1) % 3 + 3], v[i]));
        }
        break;
      case ElementKind::Pyramid:
        for (std::size_t i = 0; i < 4; ++i) least = std::min(least, spat(v[i], v[(i + 1) % 4], v[(i + 3) % 4], v[4]));
        break;
    }
    inverted += least <= limit ? 1 : 0;
  }
  return inverted;
}

/// Numbers of trials, which show whether the test means anything.
struct Tried {
  std::size_t runs = 0, tangled = 0, untangled = 0, less = 0;
  void add(Index before, Index after) {
    ++runs;
    tangled += before > 0 ? 1 : 0;
    untangled += before > 0 && after == 0 ? 1 : 0;
    less += after < before ? 1 : 0;
  }
  void tell() const {
    for (const auto& [name, count] : {std::pair{"runs", runs}, {"tangled", tangled}, {"untangled", untangled}, {"less", less}})
      ::testing::Test::RecordProperty(name, static_cast<int>(count));
    fmt::print("{} runs, {} of them on tangled meshes: {} untangled, {} with fewer inverted elements\n", runs, tangled, untangled, less);
  }
};

/// Smooths, and expects no iteration to be worse. `sound_enough`: with combined aims, the minimum may fall to this.
void expect_never_worse(const std::shared_ptr<const InputMesh>& mesh, const RunParameters& parameters, std::uint64_t iterations,
                        const std::string& what, Tried& tried, double sound_enough = HUGE_VAL) {
  dmoscope::Run run = make_run(mesh, parameters);
  Progress progress;
  const Index first = run.statistics().inverted;
  Index inverted = first;
  double minimum = run.statistics().minimum;
  for (std::uint64_t i = 1; i <= iterations; ++i) {
    run.step(StepUnit::Iteration, progress);
    const Index now = run.statistics().inverted;
    constexpr double kRounding = 1e-11;                           // flat elements may be counted either way
    const double between = mesh->is_volume() ? 1e-3 : kRounding;  // the places inside that are tested; a cell has 0.037
    ASSERT_GE(now, count_below(*mesh, run.positions(), -kRounding)) << what << ", iteration " << i;
    ASSERT_LE(now, count_below(*mesh, run.positions(), between)) << what << ", iteration " << i;
    ASSERT_LE(now, inverted) << what << ", iteration " << i;
    ASSERT_GE(run.statistics().minimum, std::min(minimum, sound_enough)) << what << ", iteration " << i;
    inverted = now;
    minimum = run.statistics().minimum;
  }
  tried.add(first, inverted);
}

/// A mesh over the unit square or cube, `cells` along an edge.
struct Base {
  std::string name;
  Mesh mesh;
  double cells;
};
std::vector<Base> planar_meshes(Index n) {
  return {{"triangles", lattice(n, 0.2, 71), static_cast<double>(n)},
          {"quadrilaterals", lattice(n, 0.2, 72, Cells::Quadrilaterals), static_cast<double>(n)},
          {"mixed", lattice(n, 0.2, 73, Cells::Mixed), static_cast<double>(n)}};
}

/// Calls body(mesh, what) for each spoiled mesh on which the metric is defined.
template <class Body>
void for_spoiled(const std::vector<Base>& meshes, Metric metric, std::uint64_t seeds, const Body& body) {
  for (const auto& [name, mesh, cells] : meshes) {
    if (!testing::defined_for_all(metric, mesh)) continue;
    for (const Spoiling spoiling : testing::kSpoilings)
      for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        body(input(spoiled(mesh, cells, spoiling, seed)), fmt::format("{}, {} {}, {}", name, name_of(spoiling), seed, info(metric).name));
  }
}

class NeverWorse : public ::testing::TestWithParam<MethodInfo> {};

std::vector<MethodInfo> optimisers() {
  std::vector<MethodInfo> all;
  for (const MethodInfo& method : method_table())
    if (method.optimises) all.push_back(method);
  return all;
}

TEST_P(NeverWorse, OnTangledPlanarMeshesByEveryMetric) {
  Tried tried;
  for (const Metric metric : testing::all_metrics()) {
    for_spoiled(planar_meshes(6), metric, 6, [&](const auto& mesh, const std::string& what) {
      if (!testing::can_optimise(GetParam(), metric, *mesh)) return;
      RunParameters parameters{.method = std::string(GetParam().name), .metric = metric};
      expect_never_worse(mesh, parameters, 8, what, tried);
      parameters.order.seed = 5;
      expect_never_worse(mesh, parameters, 8, what + ", shuffled", tried);
    });
  }
  tried.tell();
  EXPECT_GT(tried.tangled, tried.runs / 2);
  EXPECT_GT(tried.less, tried.tangled / 3);
}

TEST_P(NeverWorse, OnTangledVolumes) {
  const std::vector<Base> meshes{{"tetrahedra", test::volume_grid(3, Fill::Tetrahedra, 0.15), 3.0},
                                 {"hexahedra", test::volume_grid(3, Fill::Hexahedra, 0.15), 3.0},
                                 {"mixed", test::volume_grid(3, Fill::Mixed, 0.15), 3.0}};
  Tried tried;
  for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian}) {
    for_spoiled(meshes, metric, 2, [&](const auto& mesh, const std::string& what) {
      expect_never_worse(mesh, {.method = std::string(GetParam().name), .metric = metric, .search = {.grid_points = 4}}, 6, what, tried);
    });
  }
  tried.tell();
  EXPECT_GT(tried.tangled, tried.runs / 3);
}

INSTANTIATE_TEST_SUITE_P(Optimisers, NeverWorse, ::testing::ValuesIn(optimisers()), [](const auto& tested) {
  std::string name(tested.param.name);
  std::erase(name, '-');
  return name;
});

TEST(NeverWorseAlso, WithBothPhasesOtherGridsAndTheSearchInDouble) {
  Tried tried;
  for_spoiled(planar_meshes(6), Metric::MeanRatio, 5, [&](const auto& mesh, const std::string& what) {
    expect_never_worse(mesh, {.then_mean = PhaseBegin{.patience = 3}}, 30, what + ", then mean", tried);
    expect_never_worse(mesh, {.search = {.omega = 1.0}}, 8, what + ", omega 1", tried);
    expect_never_worse(mesh, {.search = {.grid_points = 5, .levels = 1, .precision = Precision::Double}}, 8, what + ", in double", tried);
  });
  tried.tell();
  EXPECT_GT(tried.untangled, 20U);
}

TEST(NeverWorseAlso, CombinedDownToTheThreshold) {
  Tried tried;
  const CompositeTerms combination{.threshold = 0.3, .second = Metric::MinAngle};
  for_spoiled({{"triangles", lattice(6, 0.2, 71), 6.0}}, Metric::MeanRatio, 12, [&](const auto& mesh, const std::string& what) {
    expect_never_worse(mesh, {.combination = combination}, 10, what + ", combined", tried, combination.threshold);
  });
  tried.tell();
  EXPECT_GT(tried.untangled, 5U);
}

/// Attempts begin and end: their gains must stay in between and after, for long.
TEST(NeverWorseAlso, ThroughAllAttemptsAndTheRestsBetweenThem) {
  Tried tried;
  for_spoiled(planar_meshes(5), Metric::MeanRatio, 3,
              [&](const auto& mesh, const std::string& what) { expect_never_worse(mesh, {}, 130, what, tried); });
  tried.tell();
  EXPECT_GT(tried.tangled, 10U);
}

/// The boundary vertex of one star is put far on the other side: no move can untangle that, and no other place may suffer from it.
TEST(NeverWorseAlso, DamageThatCannotBeRepairedDoesNotSpread) {
  const Mesh sound = lattice(16, 0.3, 74);
  Mesh wrong = sound;
  const Index vertex = 8;  // on the lower side
  wrong.positions[vertex].y += 30.0;
  const auto mesh = input(wrong);
  Progress progress;
  dmoscope::Run with = make_run(mesh, {}), without = make_run(input(sound), {});
  const Index before = with.statistics().inverted;
  ASSERT_GT(before, 0U);
  with.until_converged({}, progress);
  without.until_converged({}, progress);
  EXPECT_LE(with.statistics().inverted, before);
  // Elements three and more rows away are as good as in the mesh without the fault, and none is inverted.
  double least = 1.0, least_without = 1.0;
  for (Index e = 0; e < sound.elements.size(); ++e) {
    const auto corners = sound.elements.corners(e);
    if (std::ranges::any_of(corners, [&](Index v) { return length(sound.positions[v] - sound.positions[vertex]) < 3.0 / 16.0; })) continue;
    const auto quality = [e](const dmoscope::Run& run) {
      return element_quality(run.input().quality_context(), run.positions(), Metric::MeanRatio, e);
    };
    least = std::min(least, quality(with));
    least_without = std::min(least_without, quality(without));
  }
  EXPECT_GT(least, 0.8 * least_without);
}

}  // namespace
}  // namespace dmoscope
