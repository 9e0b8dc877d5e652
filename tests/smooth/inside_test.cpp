// Elements never become inverted inside, which their corners do not show.

#include "tests/support/inside.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using test::Fill;
using testing::input;
using testing::make_run;

class Inside : public ::testing::TestWithParam<MethodInfo> {};

TEST_P(Inside, NothingIsInvertedThere) {
  Progress progress;
  int runs = 0, rises = 0;
  for (const Fill fill : {Fill::Hexahedra, Fill::Mixed})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const auto mesh = input(test::twisted_block(3, fill, seed));
      for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian, Metric::Condition}) {
        if (!testing::can_optimise(GetParam(), metric, *mesh)) continue;
        for (const Precision precision : {Precision::Float, Precision::Double}) {
          if (precision == Precision::Double && !GetParam().searches_grid) continue;
          RunParameters parameters{.method = std::string(GetParam().name), .metric = metric};
          parameters.search.precision = precision;
          if (precision == Precision::Double) parameters.search.grid_points = 4;
          dmoscope::Run run = make_run(mesh, parameters);
          const std::string what = fmt::format("{} {}, seed {}", GetParam().name, info(metric).name, seed);
          for (int i = 0; i < 6; ++i) {
            run.step(StepUnit::Iteration, progress);
            ASSERT_EQ(test::inverted_inside(mesh->mesh, run.positions()), 0U) << what << ", iteration " << i;
            ASSERT_EQ(run.statistics().inverted, 0U) << what << ", iteration " << i;
          }
          const double before =
              compute_statistics(mesh->quality_context(), mesh->mesh.positions, metric, std::span<const Index>(), nullptr).minimum;
          EXPECT_GE(run.statistics().minimum, before) << what;
          rises += run.statistics().minimum > before ? 1 : 0;
          ++runs;
        }
      }
    }
  EXPECT_GT(runs, 0);
  EXPECT_GT(2 * rises, runs) << "or it is sound because nothing moves";
}

/// Ways to smooth a volume with two aims, or with a sliding boundary.
std::vector<RunParameters> other_ways(const MethodInfo& method) {
  const std::string name(method.name);
  RunParameters slides{.method = name, .boundary = BoundaryRule::Slide}, both{.method = name}, other{.method = name};
  both.combination = CompositeTerms{0.3, Metric::ScaledJacobian};
  other.metric = Metric::ScaledJacobian;
  other.combination = CompositeTerms{0.2, Metric::Condition};
  RunParameters all = both;
  all.boundary = BoundaryRule::Slide;
  return {slides, both, other, all};
}

/// Blocks and rods that are sound everywhere stay so by two aims and with a sliding boundary.
TEST_P(Inside, NothingIsInvertedThereByTwoAimsOrWhereTheBoundarySlides) {
  Progress progress;
  std::size_t moved = 0;
  std::vector<std::shared_ptr<const InputMesh>> meshes{input(test::twisted_block(3, Fill::Mixed, 11)),
                                                       input(test::twisted_block(3, Fill::Hexahedra, 12)),
                                                       input(test::bent_rod(0.75, 0.62, 1.5, 3))};
  for (const auto& mesh : meshes) {
    ASSERT_EQ(test::inverted_inside(mesh->mesh, mesh->mesh.positions), 0U);
    for (const RunParameters& parameters : other_ways(GetParam())) {
      const bool takes_long = GetParam().joint && parameters.boundary == BoundaryRule::Slide;
      if (takes_long && mesh != meshes.front()) continue;
      dmoscope::Run run = make_run(mesh, parameters);
      for (int i = 0; i < (takes_long ? 1 : GetParam().joint ? 3 : 5); ++i) {
        moved += run.step(StepUnit::Iteration, progress);
        ASSERT_EQ(test::inverted_inside(mesh->mesh, run.positions()), 0U) << run.title() << ", iteration " << i;
        ASSERT_EQ(run.statistics().inverted, 0U) << run.title() << ", iteration " << i;
      }
    }
  }
  EXPECT_GT(moved, 100U);
}

/// A thin wall, crushed so that some of it is inverted, half of that inside alone: no iteration adds to it.
TEST_P(Inside, NoMoreIsInvertedOfACrushedCan) {
  Progress progress;
  for (const double fold : {0.1, 0.25}) {
    const auto mesh = input(test::crushed_can(0.6, fold, 5));
    const Index before = test::inverted_inside(mesh->mesh, mesh->mesh.positions);
    ASSERT_GT(before, 10U);
    for (const RunParameters& parameters : {RunParameters{.method = std::string(GetParam().name)}, other_ways(GetParam()).back()}) {
      dmoscope::Run run = make_run(mesh, parameters);
      Index left = before, said = run.statistics().inverted;
      EXPECT_GE(said, before) << "what is not proved counts";
      for (int i = 0; i < (GetParam().joint ? 3 : 5); ++i) {
        run.step(StepUnit::Iteration, progress);
        const Index now = test::inverted_inside(mesh->mesh, run.positions());
        EXPECT_LE(run.statistics().inverted, said) << run.title() << ", iteration " << i;
        EXPECT_GE(run.statistics().inverted, now) << run.title() << ", iteration " << i;
        said = run.statistics().inverted;
        left = now;
      }
      EXPECT_LT(left, before) << run.title();
    }
  }
}

std::vector<MethodInfo> volume_optimisers() {
  std::vector<MethodInfo> all;
  for (const MethodInfo& method : method_table())
    if (method.optimises && !method.planar_only) all.push_back(method);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Optimisers, Inside, ::testing::ValuesIn(volume_optimisers()), [](const auto& tested) {
  std::string name(tested.param.name);
  std::erase(name, '-');
  return name;
});

/// The metric of the inside is raised, and no visit lowers it; the same bits for any number of threads.
TEST(InsideAlone, IsRaisedByItsMetric) {
  const Metric metric = parse_metric("scaled-jacobian-inside");
  Progress progress;
  for (const Fill fill : {Fill::Hexahedra, Fill::Mixed})
    for (const char* method : {"dmo", "pattern-search", "smart-laplace"}) {
      const auto mesh = input(test::twisted_block(4, fill, 3));
      const RunParameters parameters{.method = method, .metric = metric};
      dmoscope::Run run = make_run(mesh, parameters), other = make_run(mesh, parameters, 3);
      const double before = run.statistics().minimum;
      testing::expect_promise_one({method, mesh->mesh}, run, 6);
      EXPECT_GT(run.statistics().minimum, before + (method == std::string_view("smart-laplace") ? 0.0 : 0.05)) << method;
      EXPECT_EQ(test::inverted_inside(mesh->mesh, run.positions()), 0U);
      other.iterate(6, progress);
      EXPECT_TRUE(same_bits(run.positions(), other.positions())) << method;
    }
}

/// A hexahedron that is sound by its corners: the least of their Jacobians is 92. Half-way up its second edge the determinant is negative.
TEST(InsideAlone, IsCountedAsInverted) {
  Mesh mesh;
  mesh.positions = {{5, -6, -2}, {11, -6, -2}, {17, 6, 3}, {7, 6, 1}, {7, -2, 15}, {5, 5, 5}, {4, 4, 11}, {2, 6, 8}};
  mesh.elements.add(ElementKind::Hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  ASSERT_EQ(test::inverted_inside(mesh, mesh.positions), 1U);
  const auto prepared = input(mesh);
  EXPECT_EQ(prepared->report.inverted_elements, std::vector<Index>{0});
  for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian}) {
    const Statistics found = compute_statistics(prepared->quality_context(), mesh.positions, metric, std::span<const Index>(), nullptr);
    EXPECT_EQ(found.inverted, 1U);
    EXPECT_GT(found.minimum, 0.0) << "what corners say";
  }
}

/// 27 hexahedra, the middle one inverted inside alone; the rim is fixed.
Mesh swivelled_block() {
  Mesh mesh = test::volume_grid(3, Fill::Hexahedra);
  mesh.positions[21] = {0.4182, 0.4752, 0.4933};
  mesh.positions[22] = {0.6675, 0.1633, 0.2106};
  mesh.positions[25] = {0.4476, 0.5873, 0.3507};
  mesh.positions[26] = {0.6554, 0.5420, 0.4567};
  mesh.positions[37] = {0.3436, 0.2798, 0.8168};
  mesh.positions[38] = {0.5023, 0.2979, 0.6275};
  mesh.positions[41] = {0.1694, 0.4977, 0.7344};
  mesh.positions[42] = {0.6409, 0.7755, 0.8199};
  return mesh;
}

TEST(InsideAlone, IsUntangledByAllThatOptimise) {
  const auto mesh = input(swivelled_block());
  ASSERT_EQ(mesh->report.inverted_elements.size(), 1U);
  ASSERT_EQ(test::inverted_inside(mesh->mesh, mesh->mesh.positions), 1U);
  const auto sound_after = [&](const RunParameters& parameters) {
    dmoscope::Run run = make_run(mesh, parameters);
    Progress progress;
    run.iterate(80, progress);
    return run.statistics().inverted == 0 && test::inverted_inside(mesh->mesh, run.positions()) == 0;
  };
  for (const MethodInfo& method : volume_optimisers()) {
    const std::string name(method.name);
    EXPECT_TRUE(sound_after({.method = name})) << name;
    EXPECT_TRUE(sound_after({.method = name, .metric = Metric::ScaledJacobian})) << name;
    if (!method.joint) {
      EXPECT_TRUE(sound_after({.method = name, .metric = parse_metric("formula:min_corner(det/norm^3)")})) << name;
    }
  }
  RunParameters two_aims;
  two_aims.combination = CompositeTerms{0.3, Metric::ScaledJacobian};
  EXPECT_TRUE(sound_after(two_aims));
}

TEST(InsideAlone, IsTheFirstWithItsPlaceAmongThoseThatAreNamed) {
  Mesh mesh;
  mesh.positions = {{5, -6, -2}, {11, -6, -2}, {17, 6, 3}, {7, 6, 1},  {7, -2, 15}, {5, 5, 5},   {4, 4, 11},  {2, 6, 8},
                    {30, 0, 0},  {34, 0, 0},   {34, 4, 0}, {30, 4, 0}, {30, 0, 4},  {34, 0, -4}, {34, 4, -4}, {30, 4, 4}};
  for (Index first : {8U, 0U}) {  // the other is inverted at its corners
    std::array<Index, 8> corners{};
    for (Index& corner : corners) corner = first++;
    mesh.elements.add(ElementKind::Hexahedron, corners);
  }
  const InvertedCount found = count_inverted(input(mesh)->quality_context(), mesh.positions);
  EXPECT_EQ(found.all, 2U);
  EXPECT_EQ(found.inside_alone, 1U);
  ASSERT_EQ(found.first.size(), 2U);
  EXPECT_EQ(found.first[0].number, 0U);
  EXPECT_FALSE(found.first[0].inside_alone);
  EXPECT_EQ(found.first[0].at, (Vec3{32, 2, 0}));
  EXPECT_EQ(found.first[1].number, 1U);
  EXPECT_TRUE(found.first[1].inside_alone);
  // The map from the unit cube, at places whose coordinates are sixteenths; its derivatives are differences, as it is linear in each.
  const auto place = [&](double x, double y, double z) {
    Vec3 sum;
    for (Index i = 0; i < 8; ++i)
      sum = sum + ((i % 4 == 1 || i % 4 == 2 ? x : 1.0 - x) * (i % 4 >= 2 ? y : 1.0 - y) * (i >= 4 ? z : 1.0 - z)) * mesh.positions[i];
    return sum;
  };
  int met = 0;
  for (int i = 0; i < 17 * 17 * 17; ++i) {
    const double x = i % 17 / 16.0, y = i / 17 % 17 / 16.0, z = i / 289 / 16.0;
    if (length(place(x, y, z) - found.first[1].at) > 1e-12) continue;
    const Vec3 dx = place(1, y, z) - place(0, y, z), dy = place(x, 1, z) - place(x, 0, z), dz = place(x, y, 1) - place(x, y, 0);
    EXPECT_LE(dot(dx, cross(dy, dz)), 0.0);
    ++met;
  }
  EXPECT_EQ(met, 1);
}

}  // namespace
}  // namespace dmoscope
