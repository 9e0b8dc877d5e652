// Two aims at once: the search against one written apart, its optimum, and its promises.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/mesh/generate.h"
#include "core/mesh/random.h"
#include "core/run/run.h"
#include "core/smooth/methods/grid.h"
#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/visit.h"
#include "tests/smooth/promises.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::input;
using testing::lattice;
using Point = Vec2<double>;

using testing::make_run;

RunParameters combined(double threshold, std::variant<Metric, SizeFunction> second) {
  RunParameters parameters;
  parameters.combination = CompositeTerms{threshold, std::move(second)};
  return parameters;
}

/// A mesh of triangles in the plane z = 0, judged by separate formulas.
struct Plain {
  const InputMesh& input;
  std::span<const Vec3> positions;

  using Corners = std::vector<Point>;  // corners of each triangle of a star, the vertex first
  [[nodiscard]] std::vector<Corners> star(Index vertex, Point at) const {
    std::vector<Corners> triangles;
    for (Index e = 0; e < input.mesh.elements.size(); ++e) {
      const auto corners = input.mesh.elements.corners(e);
      for (std::size_t k = 0; k < 3; ++k) {
        if (corners[k] != vertex) continue;
        const Vec3 b = positions[corners[(k + 1) % 3]], c = positions[corners[(k + 2) % 3]];
        triangles.push_back({at, {b.x, b.y}, {c.x, c.y}});
      }
    }
    return triangles;
  }
  static double area(const Corners& t) { return 0.5 * ((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y)); }
  static double side(const Corners& t, int k) {
    return std::hypot(t[static_cast<std::size_t>((k + 1) % 3)].x - t[static_cast<std::size_t>(k)].x,
                      t[static_cast<std::size_t>((k + 1) % 3)].y - t[static_cast<std::size_t>(k)].y);
  }
  static double mean_ratio(const Corners& t) {
    const double a = side(t, 0), b = side(t, 1), c = side(t, 2);
    return 4 * std::sqrt(3.0) * area(t) / (a * a + b * b + c * c);
  }
  static double min_angle(const Corners& t) {
    const double a = side(t, 0), b = side(t, 1), c = side(t, 2);
    const auto opposite = [](double x, double y, double z) { return std::acos((y * y + z * z - x * x) / (2 * y * z)); };
    return std::copysign(3 / M_PI * std::min({opposite(a, b, c), opposite(b, c, a), opposite(c, a, b)}), area(t));
  }
};

/// Rank of a place: by the first number, and among equals by the second; greater is better.
using Worth = std::pair<int, double>;

using SecondAim = std::function<double(const std::vector<Plain::Corners>&, Point)>;

Worth worth(const Plain& mesh, Index vertex, Point at, double threshold, bool inclusive, const SecondAim& second) {
  const auto star = mesh.star(vertex, at);
  double least = INFINITY;
  for (const auto& triangle : star) least = std::min(least, Plain::mean_ratio(triangle));
  if (inclusive ? least >= threshold : least > threshold) return {1, second(star, at)};
  return {0, least};
}

/// The paper's Algorithm 2 over that order; returns the best place, and whether it is another one.
Point best_place(const Plain& mesh, Index vertex, const std::function<Worth(Point)>& worth_at) {
  const Point here{mesh.positions[vertex].x, mesh.positions[vertex].y};
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (const auto& triangle : mesh.star(vertex, here))
    for (std::size_t k = 1; k < 3; ++k) {
      low = {std::min(low.x, triangle[k].x), std::min(low.y, triangle[k].y)};
      high = {std::max(high.x, triangle[k].x), std::max(high.y, triangle[k].y)};
    }
  Point best = here;
  Worth most = worth_at(here);
  double omega = 0.5;
  for (int level = 0; level < 3; ++level) {
    const Point centre = best;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j) {
        const Point p{centre.x + omega * (high.x - low.x) * (i / 7.0 - 0.5), centre.y + omega * (high.y - low.y) * (j / 7.0 - 0.5)};
        if (const Worth w = worth_at(p); w > most) {
          most = w;
          best = p;
        }
      }
    omega *= 2.0 / 7.0;
  }
  return best;
}

/// Compares the search with the one above for every free vertex without inverted elements; returns how many had a best place beyond the
/// threshold, and below.
std::pair<int, int> compare(const InputMesh& mesh, const CompositeObjective& composite, const SecondAim& second) {
  const Plain plain{mesh, mesh.mesh.positions};
  SmoothingTask task;
  task.input = std::shared_ptr<const InputMesh>(std::shared_ptr<void>(), &mesh);
  const Visit<Plane, Grid> search(task, composite, Grid(task, composite));
  Visit<Plane, Grid>::Scratch scratch;
  std::pair<int, int> counts{};
  for (Index v = 0; v < mesh.mesh.vertex_count(); ++v) {
    if (mesh.topology.boundary()[v] != 0) continue;
    bool tangled = false;
    for (const auto& triangle : plain.star(v, {mesh.mesh.positions[v].x, mesh.mesh.positions[v].y}))
      tangled |= Plain::area(triangle) <= 0.0;
    if (tangled) continue;
    const auto worth_at = [&](Point p) { return worth(plain, v, p, composite.threshold, composite.raise_mean(), second); };
    const Point expected = best_place(plain, v, worth_at);
    const Vec3 here = mesh.mesh.positions[v];
    const Vec3 found = search.target(mesh.mesh.positions, v, scratch).value_or(here);
    EXPECT_NEAR(found.x, expected.x, 1e-9) << v;
    EXPECT_NEAR(found.y, expected.y, 1e-9) << v;
    ++(worth_at(expected).first == 1 ? counts.first : counts.second);
  }
  return counts;
}

TEST(VisitByTwoAims, FindsTheBestInTheOrderOfTheTwoAims) {
  const auto mesh = input(lattice(12, 0.35, 5));
  const auto least_angle = [](const std::vector<Plain::Corners>& star, Point) {
    double least = INFINITY;
    for (const auto& triangle : star) least = std::min(least, Plain::min_angle(triangle));
    return least;
  };
  const auto [beyond, below] = compare(*mesh, composite_objective(Metric::MeanRatio, {0.7, Metric::MinAngle}, nullptr), least_angle);
  EXPECT_GT(beyond, 20);
  EXPECT_GT(below, 5);
}

/// The power mean of a star's mean ratios, by the kind's exponent; the harmonic one counts first how few are below .1, then .2, .3 and .4.
SecondAim power_mean(MeanKind kind) {
  const double exponent = kind == MeanKind::Arithmetic      ? 1.0
                          : kind == MeanKind::Harmonic      ? -1.0
                          : kind == MeanKind::InverseSquare ? -2.0
                                                            : 0.0;
  return [exponent](const std::vector<Plain::Corners>& star, Point) {
    double sum = 0.0;
    for (const auto& triangle : star) {
      const double quality = Plain::mean_ratio(triangle);
      sum += exponent == 0.0 ? std::log(quality) : std::pow(quality, exponent);
      if (exponent == -1.0)
        for (int level = 1; level <= 4; ++level) sum += quality < level / 10.0 ? std::pow(100.0, 6 - level) : 0.0;
    }
    const double mean = sum / static_cast<double>(star.size());
    return exponent == 0.0 ? std::exp(mean) : std::pow(mean, 1.0 / exponent);
  };
}

TEST(VisitByTwoAims, RaisesTheMeanAboveTheFloor) {
  const auto mesh = input(lattice(12, 0.35, 6));
  for (const MeanKind kind : kMeanKinds) {
    SCOPED_TRACE(name(kind));
    // The built-in metric, and a formula with the same values.
    for (const Metric metric : {Metric::MeanRatio, parse_metric("formula:2*det/norm^2")}) {
      const auto [beyond, below] = compare(*mesh, raise_mean_above(metric, 0.55, kind), power_mean(kind));
      EXPECT_GT(beyond, 20);
      EXPECT_GT(below, 5);
    }
  }
}

TEST(VisitByTwoAims, GoesForTheWeightedMeanOfTheNeighbours) {
  const auto mesh = input(lattice(12, 0.35, 7));
  const Vec3 point{0.3, 0.4, 0.0};
  const auto size = std::make_shared<const SizeField>(mesh, SizeFunction{SizeFunction::Kind::Distance, point, {}});
  const auto density = [&](const std::vector<Plain::Corners>& star, Point at) {
    double x = 0.0, y = 0.0, weights = 0.0;
    for (const auto& triangle : star) {  // each neighbour once: the corner after the vertex
      const double weight = 1.0 / std::hypot(triangle[1].x - point.x, triangle[1].y - point.y);
      x += weight * triangle[1].x;
      y += weight * triangle[1].y;
      weights += weight;
    }
    return -std::hypot(at.x - x / weights, at.y - y / weights);
  };
  const auto [beyond, below] = compare(*mesh, composite_objective(Metric::MeanRatio, CompositeTerms{0.6}, size), density);
  EXPECT_GT(beyond, 20);
  EXPECT_GT(below, 5);
}

/// Expects moves to be allowed by the words of promise 1, for places near and far, inside the ring and outside.
void expect_gains_as_promised(const CompositeObjective& composite, const SecondAim& second) {
  Random random(17);
  int allowed = 0, refused_below = 0, refused_tangled = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Mesh mesh;
    const auto place = [&](double reach) { return Vec3{random.between(-reach, reach), random.between(-reach, reach), 0}; };
    mesh.positions.push_back(place(trial % 4 < 2 ? 0.4 : 1.2));
    for (int k = 0; k < 6; ++k) mesh.positions.push_back(Vec3{std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0.0} + place(0.2));
    for (Index k = 0; k < 6; ++k) testing::add(mesh, {0, k + 1, (k + 1) % 6 + 1});
    const auto wheel = input(mesh);
    if (wheel->report.flipped_elements > 0) continue;  // so tangled that it was turned over
    const Vec3 here = mesh.positions[0], there = trial % 2 == 0 ? place(1.2) : here + place(0.3);
    const Plain plain{*wheel, wheel->mesh.positions};
    struct At {
      double jacobian, first, second;
      std::uint32_t inverted = 0;  // bits of the elements
      double flattest = INFINITY;  // the least size of a quality
    };
    const auto look = [&](Vec3 p) {
      const Point at{p.x, p.y};
      std::vector<Vec3> positions = wheel->mesh.positions;
      positions[0] = p;
      At found{star_state(*wheel, positions, Metric::MeanRatio, 0).jacobian, INFINITY, second(plain.star(0, at), at)};
      std::uint32_t bit = 1;
      for (const auto& triangle : plain.star(0, at)) {
        const double quality = Plain::mean_ratio(triangle);
        found.first = std::min(found.first, quality);
        found.inverted |= quality <= 0.0 ? bit : 0;
        bit <<= 1U;
        found.flattest = std::min(found.flattest, std::abs(quality));
      }
      return found;
    };
    const At before = look(here), after = look(there);
    // The harmonic mean counts the inverse of flatter elements, whatever else becomes bad.
    if (std::min(before.flattest, after.flattest) < 2e-3) continue;
    const auto beyond = [&](double q) { return composite.raise_mean() ? q > 0.0 && q >= composite.threshold : q > composite.threshold; };
    const bool rises = after.second > before.second;
    bool expected = after.jacobian > 0.0 && (beyond(before.first) ? beyond(after.first) && rises : after.first > before.first);
    if (before.jacobian <= 0.0)
      expected = after.jacobian > before.jacobian && (after.inverted & ~before.inverted) == 0 &&
                 (!composite.raise_mean() || (after.first >= before.first && rises));
    const bool gains = StarJudge<Plane>(*wheel, composite).confirm(wheel->mesh.positions, 0, there) == Confirmation::Gains;
    EXPECT_EQ(gains, expected) << trial;
    allowed += gains ? 1 : 0;
    refused_below += beyond(before.first) && rises && !beyond(after.first) ? 1 : 0;
    refused_tangled += !gains && before.jacobian <= 0.0 && after.jacobian > before.jacobian ? 1 : 0;
  }
  EXPECT_GT(allowed, 200);
  // Means that a bad element lowers much hardly rise if an element falls below the floor.
  const auto* mean = std::get_if<MeanOfStar>(&composite.second);
  EXPECT_GT(refused_below, mean == nullptr || mean->kind == MeanKind::Arithmetic ? 2 : 0);
  EXPECT_TRUE(!composite.raise_mean() || refused_tangled > 20);
}

TEST(VisitByTwoAims, AVertexGainsAsPromised) {
  expect_gains_as_promised(composite_objective(Metric::MeanRatio, {0.5, Metric::MinAngle}, nullptr),
                           [](const std::vector<Plain::Corners>& star, Point) {
                             double least = INFINITY;
                             for (const auto& triangle : star) least = std::min(least, Plain::min_angle(triangle));
                             return least;
                           });
  for (const MeanKind kind : kMeanKinds) expect_gains_as_promised(raise_mean_above(Metric::MeanRatio, 0.5, kind), power_mean(kind));
}

TEST(CompositeObjective, TheThresholdItselfIsNotBeyondButTheFloorIs) {
  const CompositeObjective both = composite_objective(Metric::MeanRatio, {0.7, Metric::MinAngle}, nullptr);
  EXPECT_FALSE(both.beyond(0.7)) << "eq. (8)";
  EXPECT_TRUE(both.beyond(std::nextafter(0.7, 1.0)));
  const CompositeObjective mean = raise_mean_above(Metric::MeanRatio, 0.7);
  EXPECT_TRUE(mean.beyond(0.7)) << "or the star that sets the floor could not rise";
  EXPECT_FALSE(mean.beyond(std::nextafter(0.7, 0.0)));
  EXPECT_FALSE(raise_mean_above(Metric::MeanRatio, -0.3).beyond(0.0)) << "inverted";
}

TEST(Density, IsOneAtTheWeightedMeanAndAHalfAMeanEdgeAway) {
  Mesh mesh;  // a rhombus with its hub anywhere
  mesh.positions = {{0.1, 0.2, 0}, {2, 0, 0}, {0, 1, 0}, {-2, 0, 0}, {0, -1, 0}};
  for (Index i = 1; i <= 4; ++i) testing::add(mesh, {0, i, i % 4 + 1});
  const auto rhombus = input(mesh);
  const SizeField size(rhombus, {SizeFunction::Kind::Distance, {2, -1, 0}, {}});
  const DensityTarget<Plane> target = size.target(rhombus->planar_view(), rhombus->mesh.positions, 0);
  // Weights: 1 over the distances 1, 2 sqrt 2, sqrt 17, 2.
  const double a = 1, b = 1 / std::sqrt(8.0), c = 1 / std::sqrt(17.0), d = 0.5, sum = a + b + c + d;
  const Point mean{(2 * a - 2 * c) / sum, (b - d) / sum};
  EXPECT_NEAR(target.offset.x, mean.x - 0.1, 1e-15);
  EXPECT_NEAR(target.offset.y, mean.y - 0.2, 1e-15);
  const double edge = 0.25 * (std::hypot(1.9, 0.2) + std::hypot(0.1, 0.8) + std::hypot(2.1, 0.2) + std::hypot(0.1, 1.2));
  EXPECT_DOUBLE_EQ(target.density(target.offset), 1.0);
  EXPECT_NEAR(target.density({target.offset.x + 0.6 * edge, target.offset.y - 0.8 * edge}), 0.5, 1e-15);
}

TEST(Combined, OneVertexEndsAtTheWeightedMean) {
  Mesh mesh;  // a hub in a regular hexagon, far to one side of it
  mesh.positions.push_back({0.45, -0.2, 0.0});
  for (int k = 0; k < 6; ++k) mesh.positions.push_back({std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0.0});
  for (Index k = 0; k < 6; ++k) testing::add(mesh, {0, k + 1, (k + 1) % 6 + 1});
  const auto hexagon = input(std::move(mesh));
  for (const auto& [kind, sign] : {std::pair{SizeFunction::Kind::Distance, -1.0}, {SizeFunction::Kind::InverseDistance, 1.0}}) {
    RunParameters parameters = combined(0.05, SizeFunction{kind, {3.0, 1.0, 0.0}, {}});
    parameters.search.levels = 9;
    auto run = make_run(hexagon, parameters);
    Progress progress;
    run.iterate(5, progress);
    double x = 0.0, y = 0.0, weights = 0.0;
    for (int k = 0; k < 6; ++k) {
      const double px = std::cos(k * M_PI / 3), py = std::sin(k * M_PI / 3);
      const double weight = std::pow(std::hypot(px - 3.0, py - 1.0), sign);
      x += weight * px;
      y += weight * py;
      weights += weight;
    }
    EXPECT_NEAR(run.positions()[0].x, x / weights, 1e-5);
    EXPECT_NEAR(run.positions()[0].y, y / weights, 1e-5);
  }
}

std::vector<RunParameters> kinds_of_combination() {
  return {combined(0.6, Metric::ScaledJacobian), combined(0.5, SizeFunction{}),
          combined(0.6, SizeFunction{SizeFunction::Kind::InverseDistance, {0.2, 0.7, 0.0}, {}})};
}

TEST(Combined, NeitherThreadsNorStepsChangeABit) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed})
    for (const RunParameters& parameters : kinds_of_combination()) {
      const auto mesh = input(lattice(12, 0.35, 8, cells));
      auto whole = make_run(mesh, parameters), threaded = make_run(mesh, parameters, 3), stepped = make_run(mesh, parameters);
      Progress progress;
      whole.iterate(3, progress);
      threaded.iterate(3, progress);
      while (stepped.moment().iteration < 3) stepped.step(stepped.moment().visits < 20 ? StepUnit::Vertex : StepUnit::Class, progress);
      EXPECT_TRUE(same_bits(whole.positions(), threaded.positions()));
      EXPECT_TRUE(same_bits(whole.positions(), stepped.positions()));
      EXPECT_FALSE(same_bits(whole.positions(), mesh->mesh.positions));
    }
}

/// Volumes of every kind of element, sound and tangled.
std::vector<Mesh> solids() {
  std::vector<Mesh> all;
  Progress progress;
  for (const char* kind : {"tetrahedra", "hexahedra", "tangled-solids"}) all.push_back(generate_mesh(kind, 125, 5, progress));
  Mesh tangled = all[1];
  Random random(6);
  for (Vec3& p : tangled.positions)
    if (std::min({p.x, p.y, p.z, 1 - p.x, 1 - p.y, 1 - p.z}) > 0.1 && random.below(3) == 0)
      p = {random.between(0, 1), p.y, random.between(0, 1)};
  all.push_back(std::move(tangled));
  return all;
}

TEST(Combined, BelowItsThresholdItIsThePlainSearch) {
  std::vector<Mesh> meshes = solids();
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed})
    for (const double jitter : {0.3, 0.9}) meshes.push_back(lattice(7, jitter, 9, cells));
  for (Mesh& mesh : meshes) {
    const auto prepared = input(std::move(mesh));
    auto plain = make_run(prepared, {.search = {.precision = Precision::Double}});
    auto both = make_run(prepared, combined(0.9999, Metric::ScaledJacobian));  // never reached
    Progress progress;
    for (int i = 0; i < 3; ++i) {
      plain.step(StepUnit::Iteration, progress);
      both.step(StepUnit::Iteration, progress);
      EXPECT_TRUE(same_bits(plain.positions(), both.positions())) << prepared->mesh.name << ", " << i;
    }
    if (prepared->report.inverted_elements.empty()) {  // a tangled lattice becomes regular at once
      EXPECT_LT(both.statistics().minimum, 0.9999);
    }
    EXPECT_FALSE(same_bits(both.positions(), prepared->mesh.positions));
  }
}

TEST(Combined, OfVolumesNeitherThreadsNorStepsChangeABitAndNoStarFallsBelowTheThreshold) {
  for (Mesh& mesh : solids()) {
    const auto prepared = input(std::move(mesh));
    const RunParameters parameters = combined(0.3, Metric::ScaledJacobian);
    auto threaded = make_run(prepared, parameters, 3), stepped = make_run(prepared, parameters);
    Progress progress;
    threaded.iterate(2, progress);
    const auto judge = [&](Metric metric, Index v) {
      return vertex_quality(prepared->quality_context(), prepared->topology, stepped.positions(), metric, v);
    };
    std::size_t beyond = 0;
    while (stepped.moment().iteration < 2) {
      const Index v = stepped.colouring().order[stepped.moment().visits];
      const Vec3 here = stepped.positions()[v];
      const double first = judge(Metric::MeanRatio, v), before = judge(Metric::ScaledJacobian, v);
      stepped.step(StepUnit::Vertex, progress);
      if (first <= 0.3 || stepped.positions()[v] == here) continue;
      ++beyond;
      EXPECT_GT(judge(Metric::MeanRatio, v), 0.3);
      EXPECT_GE(judge(Metric::ScaledJacobian, v), before);
    }
    EXPECT_GT(beyond, 10U) << prepared->mesh.name;
    EXPECT_TRUE(same_bits(stepped.positions(), threaded.positions())) << prepared->mesh.name;
  }
}

TEST(Combined, NoStarFallsBelowTheThresholdNorGetsWorseThere) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed})
    for (const RunParameters& parameters : kinds_of_combination()) {
      const auto mesh = input(lattice(10, 0.45, 9, cells));
      auto run = make_run(mesh, parameters);
      Progress progress;
      const double threshold = parameters.combination->threshold;
      const auto quality = [&](Index v) {
        return vertex_quality(mesh->quality_context(), mesh->topology, run.positions(), run.parameters().metric, v);
      };
      const auto jacobian = [&](Index v) {
        double least = INFINITY;
        for (const Incidence& at : mesh->topology.star(v))
          least = std::min(least,
                           smallest_jacobian(mesh->quality_context(), run.positions(), at.element) / mesh->reference_measure[at.element]);
        return least;
      };
      while (run.moment().iteration < 2) {
        const Index v = run.colouring().order[run.moment().visits];
        const Vec3 here = run.positions()[v];
        const double before = quality(v), jacobian_before = jacobian(v);
        run.step(StepUnit::Vertex, progress);
        if (run.positions()[v] == here) continue;
        if (jacobian_before <= 0.0) {
          EXPECT_GT(jacobian(v), jacobian_before);
        } else {
          EXPECT_GT(jacobian(v), 0.0);
          EXPECT_GT(quality(v), std::min(before, threshold));
        }
      }
      for (Index v = 0; v < mesh->mesh.vertex_count(); ++v) {
        if (run.fixed()[v] == 0) continue;
        EXPECT_EQ(std::memcmp(&run.positions()[v], &mesh->mesh.positions[v], sizeof(Vec3)), 0);
      }
    }
}

TEST(Combined, RefusesWhatCannotBe) {
  const auto triangles = input(lattice(4, 0.1, 1)), quadrilaterals = input(lattice(4, 0.1, 1, Cells::Quadrilaterals));
  const auto refused = [](const std::shared_ptr<const InputMesh>& mesh, const RunParameters& parameters) {
    EXPECT_THROW((void)make_run(mesh, parameters), UsageError);
  };
  refused(triangles, combined(0.0, Metric::MinAngle));
  refused(triangles, combined(1.0, Metric::MinAngle));
  refused(quadrilaterals, combined(0.7, Metric::MinAngle));
  refused(triangles, combined(0.7, Metric::MeanRatio));  // combined with itself
  refused(triangles, combined(0.7, SizeFunction{SizeFunction::Kind::Distance, {NAN, 0, 0}, {}}));
  RunParameters both = combined(0.7, SizeFunction{});
  both.then_mean.emplace();
  refused(triangles, both);
}

TEST(CompositeTerms, IsWrittenAsItIsRead) {
  for (const char* text : {"mean-ratio:0.7:density", "min-angle:0.1:radius-ratio"}) {
    const auto [metric, combination] = parse_composite(text);
    EXPECT_EQ(to_text(metric, combination), text);
  }
  for (const char* text : {"constant", "h1:1.5,-2", "h2:0.1,1e-07,3", "field:depth below: sea"})
    EXPECT_EQ(to_text(parse_size_function(text)), text);
  const auto [metric, combination] = parse_composite("mean-ratio:0.7:density", "h2:1,2");
  EXPECT_EQ(*combination.size(), (SizeFunction{SizeFunction::Kind::InverseDistance, {1, 2, 0}, {}}));
  EXPECT_EQ(phrase(metric, combination), "mean ratio > 0.7 · density h2");
  for (const char* text : {"", "mean-ratio", "mean-ratio:0.7", "mean-ratio:x:density", "mean-ratio:0:density", "mean-ratio:nan:density",
                           "beauty:0.7:density", "mean-ratio:0.7:beauty", "mean-ratio:0.7:density:h1", "mean-ratio:0.7:mean-ratio"})
    EXPECT_THROW((void)parse_composite(text), UsageError) << text;
  for (const char* text : {"h1", "h1:", "h1:1", "h1:1,2,3,4", "h1:1,x", "h1:inf,0", "h3:1,2", "field:", "constant:1"})
    EXPECT_THROW((void)parse_size_function(text), UsageError) << text;
  EXPECT_THROW((void)parse_composite("mean-ratio:0.7:min-angle", "constant"), UsageError);
}

}  // namespace
}  // namespace dmoscope
