// The methods beside dmo: results in cases that have a closed form, and refusals.

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "core/inspect/quality_field.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/methods/dvr.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::input;
using testing::lattice;
using testing::make_run;

/// A hub amid a regular ring of radius 1 around `centre`; `corners_between`: 0 for triangles, 1 for quadrilaterals.
Mesh wheel(Index spokes, Vec3 hub, Vec3 centre = {}, bool quadrilaterals = false) {
  Mesh mesh;
  mesh.name = "wheel";
  mesh.positions.push_back(centre + hub);
  const Index points = quadrilaterals ? 2 * spokes : spokes;
  for (Index i = 0; i < points; ++i) {
    const double angle = 2 * M_PI * i / points, radius = quadrilaterals && i % 2 == 1 ? std::sqrt(2.0) : 1.0;
    mesh.positions.push_back(centre + Vec3{radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (Index i = 0; i < spokes; ++i) {
    if (quadrilaterals)
      testing::add(mesh, {0, 1 + 2 * i, 2 + 2 * i, 1 + (2 * i + 2) % points});
    else
      testing::add(mesh, {0, 1 + i, 1 + (i + 1) % points});
  }
  return mesh;
}

/// Place of the hub after a number of visits.
Vec3 hub_after(const Mesh& mesh, RunParameters parameters, std::uint64_t visits = 1) {
  dmoscope::Run run = make_run(input(mesh), std::move(parameters));
  Progress progress;
  for (std::uint64_t i = 0; i < visits; ++i) run.step(StepUnit::Iteration, progress);
  return run.positions()[0];
}

TEST(Methods, EachHasANameAndOptionsOfItsOwn) {
  std::set<std::string_view> names;
  for (const MethodInfo& method : method_table()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_FALSE(method.doc.empty());
    EXPECT_EQ(method_info(method.name).name, method.name);
    EXPECT_NE(make_run(input(lattice(4, 0.1, 1)), {.method = std::string(method.name)}).visits_per_iteration(), 0U);
  }
  EXPECT_THROW((void)method_info("nonsense"), UsageError);
}

TEST(Methods, RefuseWhatTheyCannotDo) {
  const auto mesh = input(lattice(4, 0.1, 1));
  for (const double relaxation : {0.0, -0.5, 1.001, std::nan("")})
    EXPECT_THROW((void)make_run(mesh, {.method = "laplace", .options = {.relaxation = relaxation}}), UsageError) << relaxation;
  EXPECT_THROW((void)make_run(mesh, {.method = "laplace", .combination = CompositeTerms{0.5, Metric::MinAngle}}), UsageError);
  for (const char* method : {"laplace", "smart-laplace", "dvr"})
    EXPECT_THROW((void)make_run(mesh, {.method = method, .backend = Backend::Cuda}), UsageError);
}

TEST(Laplace, GoesToTheMeanOfTheEdgeNeighboursByTheShareAskedFor) {
  for (const Index spokes : {3U, 6U, 17U})
    for (const bool quadrilaterals : {false, true})
      for (const Vec3 centre : {Vec3{}, Vec3{1e6, -1e6, 7}}) {
        const Mesh mesh = wheel(spokes, {0.25, -0.125, 0}, centre, quadrilaterals);
        const double rounding = length(centre) > 0 ? 1e-9 : 2e-16;
        EXPECT_LE(length(hub_after(mesh, {.method = "laplace"}) - centre), rounding);
        const Vec3 half = hub_after(mesh, {.method = "laplace", .options = {.relaxation = 0.5}});
        EXPECT_LE(length(half - (centre + Vec3{0.125, -0.0625, 0})), rounding);
      }
}

TEST(Laplace, OfAnIrregularStarTheMeanIsOfEdgesAndEveryNeighbourCountsOnce) {
  Mesh mesh = wheel(4, {0.1, 0.2, 0}, {}, true);
  mesh.positions[2] = {9, 9, 0};  // a corner across: no edge neighbour
  mesh.positions[1] = {2, 0.5, 0};
  const Vec3 mean = 0.25 * (mesh.positions[1] + mesh.positions[3] + mesh.positions[5] + mesh.positions[7]);
  EXPECT_LE(length(hub_after(mesh, {.method = "laplace"}) - mean), 1e-15);
}

/// A ring with a deep notch: its mean lies outside.
Mesh notched() {
  Mesh mesh = wheel(6, {-0.7, 0.0, 0});
  for (const Index i : {1U, 2U, 6U}) mesh.positions[i] = {-0.55, mesh.positions[i].y, 0};
  mesh.positions[1] = {-0.65, 0, 0};
  mesh.positions[2] = {3, 0.4, 0};
  mesh.positions[6] = {3, -0.4, 0};
  return mesh;
}

TEST(SmartLaplace, GoesWhereLaplaceGoesIfItGainsThere) {
  const Mesh good = wheel(6, {0.25, -0.125, 0});
  EXPECT_EQ(hub_after(good, {.method = "smart-laplace"}), hub_after(good, {.method = "laplace"}));
  const Mesh bad = notched();
  ASSERT_GT(make_run(input(bad), {}).statistics().minimum, 0.0);
  dmoscope::Run laplace = make_run(input(bad), {.method = "laplace"});
  Progress progress;
  laplace.step(StepUnit::Iteration, progress);
  ASSERT_LT(laplace.statistics().minimum, 0.0) << "or there is nothing to refuse";
  EXPECT_EQ(hub_after(bad, {.method = "smart-laplace"}), bad.positions[0]);
}

TEST(Dvr, DirectionsFollowFromSeedAndIterationAndHaveLengthOne) {
  std::set<double> seen;
  Vec2<double> sum{};
  constexpr int kCount = 4000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const Vec2<double> d = dvr_direction({.seed = 5}, i), again = dvr_direction({.seed = 5}, i), other = dvr_direction({.seed = 6}, i);
    EXPECT_NEAR(std::hypot(d.x, d.y), 1.0, 1e-15);
    EXPECT_EQ(d.x, again.x);
    EXPECT_NE(d.x, other.x);
    seen.insert(d.x);
    const double twice = 2 * std::atan2(d.y, d.x);  // a line has no head
    sum = {sum.x + std::cos(twice), sum.y + std::sin(twice)};
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kCount));
  EXPECT_LT(std::hypot(sum.x, sum.y) / kCount, 0.05) << "no angle is likelier than another";
  const MethodOptions axes{.directions = Directions::Axes};
  EXPECT_EQ(dvr_direction(axes, 4).x, 1.0);
  EXPECT_EQ(dvr_direction(axes, 4).y, 0.0);
  EXPECT_EQ(dvr_direction(axes, 7).x, 0.0);
  EXPECT_EQ(dvr_direction(axes, 7).y, 1.0);
}

/// The least mean ratio of the hub's star with the hub moved by `t` along `d`; of one that is `tangled` the least Jacobian.
double least_at(const InputMesh& mesh, std::vector<Vec3>& positions, Index hub, Vec2<double> d, double t, bool tangled) {
  const Vec3 stands = std::exchange(positions[hub], positions[hub] + Vec3{t * d.x, t * d.y, 0});
  const StarState state = star_state(mesh, positions, Metric::MeanRatio, hub);
  positions[hub] = stands;
  return tangled ? state.jacobian : state.jacobian > 0.0 ? state.quality : -1.0;
}

/// Expects every hub's move to be the best of 8000 places on its line, and of as many close to its new place.
void expect_best_on_the_line(const Mesh& mesh, Index hubs_apart, const char* name) {
  const auto prepared = input(mesh);
  dmoscope::Run run = make_run(prepared, {.method = "dvr", .options = {.seed = 3}});
  const Vec2<double> d = dvr_direction({.seed = 3}, 0);
  std::vector<Vec3> old(run.positions().begin(), run.positions().end());
  Progress progress;
  run.visit_vertices(run.colouring().order, progress);  // an iteration of a tangled mesh would move them together
  std::size_t looked_at = 0, stayed = 0;
  for (const Index hub : run.colouring().order) {
    if (++looked_at % hubs_apart != 0) continue;
    const Vec3 way = run.positions()[hub] - old[hub];
    EXPECT_NEAR(way.x * d.y - way.y * d.x, 0.0, 1e-14) << name << ": off the line";
    const double there = way.x * d.x + way.y * d.y;
    const bool tangled = !(star_state(*prepared, old, Metric::MeanRatio, hub).jacobian > 0.0);
    if (tangled && way == Vec3{}) {  // on its line no place makes it sound, or the best one would invert others
      ++stayed;
      continue;
    }
    const auto value_at = [&](double t) { return least_at(*prepared, old, hub, d, t, tangled); };
    const double found = value_at(there);
    double best = value_at(0.0);
    constexpr int kSamples = 8000;
    for (const auto& [middle, reach] : {std::pair{0.0, 2.0}, {there, 1e-3}})
      for (int i = 0; i <= kSamples; ++i) best = std::max(best, value_at(middle + reach * (2.0 * i / kSamples - 1.0)));
    EXPECT_GE(found, best - 1e-12) << name << ": hub " << hub;
  }
  EXPECT_GE(looked_at, hubs_apart);
  EXPECT_LT(2 * stayed, looked_at) << name;
}

TEST(Dvr, FindsTheBestPlaceOnItsLine) {
  expect_best_on_the_line(testing::stars(std::vector<std::vector<int>>(12, {3, 3, 3, 3, 3}), 3), 2, "fans of five");
  expect_best_on_the_line(testing::stars({{3, 3, 3}, {3, 3, 3, 3}, std::vector<int>(9, 3), std::vector<int>(20, 3)}, 4), 1, "fans");
  expect_best_on_the_line(testing::stars(std::vector<std::vector<int>>(8, {4, 4, 4, 4}), 5), 2, "quadrilaterals");
  expect_best_on_the_line(testing::stars(std::vector<std::vector<int>>(8, {4, 3, 3, 4, 3}), 6), 2, "mixed");
  // The corners across become the worst, which no place of the hub changes: the others rise above them as far as they can.
  Mesh capped = wheel(4, {0.35, 0.3, 0}, {}, true);
  for (const Index across : {2U, 4U, 6U, 8U}) capped.positions[across] = 0.6 * capped.positions[across];
  expect_best_on_the_line(capped, 1, "capped");
  EXPECT_NEAR(hub_after(capped, {.method = "dvr", .options = {.directions = Directions::Axes}}).x, 0.0, 1e-9) << "by symmetry";
  // Hubs outside their rings: the least Jacobian counts.
  for (const int kind : {3, 4}) {
    Mesh tangled = testing::stars(std::vector<std::vector<int>>(6, std::vector<int>(5, kind)), 7);
    const std::size_t stride = tangled.positions.size() / 6;
    for (std::size_t i = 0; i < 6; ++i) {
      Vec3& hub = tangled.positions[i * stride];
      hub = hub + Vec3{0.9, 0.4, 0};
    }
    expect_best_on_the_line(tangled, 1, kind == 3 ? "tangled triangles" : "tangled quadrilaterals");
  }
}

TEST(AngleBased, TheMiddleOfARegularRingIsWhereAllAnglesAreHalved) {
  for (const Index spokes : {3U, 4U, 6U, 17U})
    for (const bool quadrilaterals : {false, true})
      for (const Vec3 centre : {Vec3{}, Vec3{1e6, -1e6, 7}}) {
        const double rounding = length(centre) > 0 ? 1e-9 : 1e-15;
        const Mesh still = wheel(spokes, {}, centre, quadrilaterals), moved = wheel(spokes, {0.2, -0.1, 0}, centre, quadrilaterals);
        EXPECT_LE(length(hub_after(still, {.method = "angle-based"}) - centre), rounding);
        EXPECT_LE(length(hub_after(moved, {.method = "angle-based"}, 200) - centre), 10 * rounding) << spokes;
        const Vec3 whole = hub_after(moved, {.method = "angle-based"}),
                   half = hub_after(moved, {.method = "angle-based", .options = {.relaxation = 0.5}});
        EXPECT_LE(length(half - 0.5 * (moved.positions[0] + whole)), rounding);
      }
}

TEST(AngleBased, ItsStepIsTheOneOfThePaperByAngles) {
  // Rings with a reflex angle, one of 240 and one of 300 degrees, by the paper's description: rotate about each of the ring's vertices by
  // half its angle less the angle to the hub.
  for (const Index spokes : {6U, 17U}) {
    Mesh mesh = wheel(spokes, {0.1, 0.05, 0});
    mesh.positions[2] = 0.3 * mesh.positions[2];
    Vec3 sum{};
    const Vec3 hub = mesh.positions[0];
    for (Index j = 1; j <= spokes; ++j) {
      const Vec3 at = mesh.positions[j], after = mesh.positions[j % spokes + 1], before = mesh.positions[(j + spokes - 2) % spokes + 1];
      const auto turn = [&](Vec3 from, Vec3 to) {  // counter-clockwise, 0 to 2 pi
        const double angle = std::atan2(to.y - at.y, to.x - at.x) - std::atan2(from.y - at.y, from.x - at.x);
        return angle < 0 ? angle + 2 * M_PI : angle;
      };
      const double by = turn(after, before) / 2 - turn(after, hub), x = hub.x - at.x, y = hub.y - at.y;
      sum = sum + at + Vec3{std::cos(by) * x - std::sin(by) * y, std::sin(by) * x + std::cos(by) * y, 0};
    }
    EXPECT_LE(length(hub_after(mesh, {.method = "angle-based"}) - 1.0 / spokes * sum), 1e-15) << spokes;
  }
}

/// Distance of hubs amid rings of random radii from the exact optimum after one visit: the median and the largest.
std::pair<double, double> gaps(const char* method) {
  std::vector<std::vector<int>> sectors;
  for (int i = 0; i < 200; ++i) sectors.emplace_back(static_cast<std::size_t>(4 + i % 5), 3);
  const auto mesh = input(testing::stars(sectors, 61));
  dmoscope::Run run = make_run(mesh, {.method = method});
  const std::vector<Vec3> old(run.positions().begin(), run.positions().end());
  Progress progress;
  run.step(StepUnit::Iteration, progress);
  std::vector<double> gap;
  for (const Index hub : run.colouring().order) {
    if (!(star_state(*mesh, old, Metric::MeanRatio, hub).jacobian > 0.0)) continue;
    const auto optimum = local_optimum(*mesh, old, Metric::MeanRatio, hub);
    gap.push_back(optimum->quality - star_state(*mesh, run.positions(), Metric::MeanRatio, hub).quality);
    EXPECT_GE(gap.back(), -1e-12) << "better than the best";
  }
  EXPECT_GT(gap.size(), 190U);
  std::ranges::sort(gap);
  return {gap[gap.size() / 2], gap.back()};
}

TEST(PatternSearch, ComesNearTheExactOptimum) {
  const auto [median, largest] = gaps("pattern-search");
  EXPECT_LT(median, 0.004);
  EXPECT_LT(largest, 0.06) << "it may rest on a ridge that runs between the axes";
}

TEST(ActiveSetAscent, ComesNearTheExactOptimum) {
  const auto [median, largest] = gaps("active-set");
  EXPECT_LT(median, 1e-5);
  EXPECT_LT(largest, 0.01);
}

/// In a regular ring the middle is best by every metric that asks for equal angles or sides.
TEST(Optimisers, FindTheMiddleOfARegularRing) {
  for (const char* method : {"pattern-search", "active-set"})
    for (const MetricInfo& entry : metric_table()) {
      if (entry.metric == Metric::Rectangularity) continue;
      for (const bool quadrilaterals : {false, true}) {
        if (!entry.defined_for(quadrilaterals ? ElementKind::Quadrilateral : ElementKind::Triangle)) continue;
        const Mesh mesh = wheel(quadrilaterals ? 4 : 6, {0.2, -0.1, 0}, {}, quadrilaterals);
        EXPECT_LE(length(hub_after(mesh, {.method = method, .metric = entry.metric}, 20)), 0.02) << method << ' ' << entry.name;
      }
    }
}

TEST(Optimisers, MakeATangledSquareOfQuadrilateralsASquareGridAgain) {
  for (const char* method : {"dvr", "pattern-search", "active-set"}) {
    dmoscope::Run run = make_run(input(lattice(5, 0.7, 62, Cells::Quadrilaterals)), {.method = method});
    ASSERT_GT(run.statistics().inverted, 0U);
    Progress progress;
    run.iterate(100, progress);
    EXPECT_GT(run.statistics().minimum, 0.999) << method;
  }
}

}  // namespace
}  // namespace dmoscope
