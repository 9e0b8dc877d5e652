// The metric of the inside of elements, against determinants and lengths at places in them, computed apart in long double.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/mesh/generate.h"
#include "core/quality/defined_judge.h"
#include "tests/support/meshes.h"

namespace dmoscope::inside_metric_test {
namespace {

using testing::input;
using testing::Random;
using Real = long double;

struct Point {
  Real x, y, z;
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator*(Real s, Point a) { return {s * a.x, s * a.y, s * a.z}; }
};
Real length(Point a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }
Real determinant_of(Point a, Point b, Point c) {
  return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
}

Metric inside() { return parse_metric("scaled-jacobian-inside"); }

/// Elements of one kind, none of which touch.
struct Elements {
  ElementKind kind;
  Mesh mesh;
  void add(std::span<const Vec3> corners) {
    std::vector<Index> order;
    for (const Vec3& p : corners) {
      order.push_back(static_cast<Index>(mesh.positions.size()));
      mesh.positions.push_back(p);
    }
    mesh.elements.add(kind, order);
  }
};

constexpr std::array<Vec3, 8> kCube{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
constexpr std::array<Vec3, 6> kPrism{
    {{0, 0, 0}, {1, 0, 0}, {0.5, 0.8660254037844386, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, 0.8660254037844386, 1}}};
/// A hexahedron that is sound by its corners alone; at (1, .55, 1) in it the determinant is negative.
constexpr std::array<Vec3, 8> kSwivel{{{74.732437133789062, 42.958683013916016, 85.311637878417969},
                                       {73.082679748535156, 44.547451019287109, 84.69134521484375},
                                       {74.776168823242188, 41.417781829833984, 86.452590942382812},
                                       {75.140121459960938, 41.464046478271484, 87.381477355957031},
                                       {73.033653259277344, 44.388099670410156, 87.84600830078125},
                                       {72.878471374511719, 44.203830718994141, 87.607704162597656},
                                       {73.799369812011719, 42.426666259765625, 86.986991882324219},
                                       {73.050018310546875, 42.325119018554688, 88.362388610839844}}};

template <std::size_t N>
Elements pushed(ElementKind kind, const std::array<Vec3, N>& ideal, int count, double push) {
  Elements all{kind, {}};
  Random random(77);
  const auto moved = [&](double x) { return x + random(-push, push); };
  for (int i = 0; i < count; ++i) {
    std::array<Vec3, N> p;
    const Vec3 wide{std::exp(random(-2, 2)), std::exp(random(-2, 2)), std::exp(random(-2, 2))};
    for (std::size_t c = 0; c < N; ++c) {
      const double x = moved(ideal[c].x), y = moved(ideal[c].y), z = moved(ideal[c].z);
      p[c] = {wide.x * x + 0.3 * wide.y * y, wide.y * y, wide.z * z};
    }
    all.add(p);
  }
  return all;
}

/// The determinant and the product of lengths at a place, so that at corners their ratio is the scaled Jacobian.
struct Here {
  Real determinant, lengths;
};
Here at(std::span<const Point> p, Real x, Real y, Real z) {
  if (p.size() == 8) {
    const auto mean = [](Real s, Real t, Point a, Point b, Point c, Point d) {
      return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
    };
    const Point a = mean(y, z, p[1] - p[0], p[2] - p[3], p[5] - p[4], p[6] - p[7]);
    const Point b = mean(x, z, p[3] - p[0], p[2] - p[1], p[7] - p[4], p[6] - p[5]);
    const Point c = mean(x, y, p[4] - p[0], p[5] - p[1], p[7] - p[3], p[6] - p[2]);
    return {determinant_of(a, b, c), length(a) * length(b) * length(c)};
  }
  const std::array<Real, 3> share{1 - x - y, x, y};  // shares of the edges between the triangles
  std::array<Point, 3> layer{};
  for (std::size_t i = 0; i < 3; ++i) layer[i] = (1 - z) * p[i] + z * p[i + 3];
  Point along{0, 0, 0};
  Real lengths = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point edge = p[i + 3] - p[i];
    along = along + share[i] * edge;
    lengths += share[i] * length(layer[(i + 1) % 3] - layer[i]) * length(layer[(i + 2) % 3] - layer[i]) * length(edge);
  }
  return {2 / std::sqrt(Real(3)) * determinant_of(layer[1] - layer[0], layer[2] - layer[0], along), lengths};
}

/// The least scaled Jacobian at 9^3 places in each element; 0 if the determinant is not positive somewhere.
std::vector<double> expect_lower_bounds(Elements elements) {
  const auto prepared = input(std::move(elements.mesh), Need::QualityOnly);
  const Mesh& mesh = prepared->mesh;
  std::vector<double> found(mesh.elements.size()), corners(found.size()), least(found.size());
  element_qualities(prepared->quality_context(), mesh.positions, inside(), nullptr, found);
  element_qualities(prepared->quality_context(), mesh.positions, Metric::ScaledJacobian, nullptr, corners);
  for (Index e = 0; e < found.size(); ++e) {
    EXPECT_EQ(element_quality(prepared->quality_context(), mesh.positions, inside(), e), found[e]) << "alone, other bits";
    std::vector<Point> p;
    for (const Index v : mesh.elements.corners(e)) p.push_back({mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z});
    Real lowest = 2;
    constexpr int kParts = 8;
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; j <= (p.size() == 6 ? kParts - i : kParts); ++j)
        for (int k = 0; k <= kParts; ++k) {
          const auto part = [](int n) { return static_cast<Real>(n) / kParts; };
          const Here here = at(p, part(i), part(j), part(k));
          lowest = std::min(lowest, std::max(Real(0), here.determinant) / here.lengths);
        }
    least[e] = static_cast<double>(lowest);
    EXPECT_LE(found[e], least[e] + 1e-12) << "element " << e;
    EXPECT_LE(found[e], corners[e] + 1e-12) << "element " << e;
  }
  for (Index e = 0; e < found.size(); ++e) least[e] -= found[e];
  return least;
}

TEST(InsideMetric, IsALowerBound) {
  for (const double push : {0.1, 0.25, 0.4, 0.6}) {
    for (const auto& gaps : {expect_lower_bounds(pushed(ElementKind::Hexahedron, kCube, 150, push)),
                             expect_lower_bounds(pushed(ElementKind::Wedge, kPrism, 150, 0.7 * push))}) {
      double sum = 0.0;
      for (const double gap : gaps) sum += gap;
      if (push <= 0.25) {
        EXPECT_LT(sum / static_cast<double>(gaps.size()), 0.03) << "and not far below, where elements are as usual";
      }
    }
  }
}

TEST(InsideMetric, IsExactWhereEdgesAreParallel) {
  Random random(5);
  const auto vector = [&] { return Vec3{random(-1, 1), random(-1, 1), random(-1, 1)}; };
  Elements bricks{ElementKind::Hexahedron, {}}, prisms{ElementKind::Wedge, {}};
  for (int i = 0; i < 200; ++i) {
    const Vec3 o = vector(), a = vector(), b = vector(), c = dot(cross(a, b), o) > 0 ? o : -1.0 * o;
    bricks.add(std::array{o, o + a, o + a + b, o + b, o + c, o + a + c, o + a + b + c, o + b + c});
    prisms.add(std::array{o, o + a, o + b, o + c, o + a + c, o + b + c});
  }
  bricks.add(kCube);
  prisms.add(kPrism);
  for (Elements* elements : {&bricks, &prisms}) {
    const auto prepared = input(std::move(elements->mesh), Need::QualityOnly);
    const auto quality = [&](Metric metric, Index e) {
      return element_quality(prepared->quality_context(), prepared->mesh.positions, metric, e);
    };
    for (Index e = 0; e < prepared->mesh.elements.size(); ++e) EXPECT_NEAR(quality(inside(), e), quality(Metric::ScaledJacobian, e), 1e-12);
    EXPECT_NEAR(quality(inside(), 200), 1.0, 1e-12);
  }
}

TEST(InsideMetric, SeesWhatCornersDoNot) {
  Elements one{ElementKind::Hexahedron, {}};
  one.add(kSwivel);
  const auto prepared = input(std::move(one.mesh), Need::QualityOnly);
  EXPECT_GT(element_quality(prepared->quality_context(), prepared->mesh.positions, Metric::ScaledJacobian, 0), 0.0);
  EXPECT_LT(element_quality(prepared->quality_context(), prepared->mesh.positions, inside(), 0), 0.0);
}

TEST(InsideMetric, IsTheScaledJacobianWhereCornersTell) {
  Progress progress;
  int others = 0;
  for (const char* words : {"tangled-solids 400", "tangled 200", "mixed 200"}) {
    const auto mesh = generate_input(words, progress);
    for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
      const ElementKind kind = mesh->mesh.elements.kind(e);
      if (kind == ElementKind::Hexahedron || kind == ElementKind::Wedge) continue;
      const auto quality = [&](Metric metric) { return element_quality(mesh->quality_context(), mesh->mesh.positions, metric, e); };
      EXPECT_NEAR(quality(inside()), quality(Metric::ScaledJacobian), 1e-12) << info(kind).name;
      ++others;
    }
  }
  EXPECT_GT(others, 300);
  EXPECT_EQ(info(inside()).lowest, -1.0);
  EXPECT_EQ(info(inside()).highest, 1.0);
  EXPECT_EQ(info(inside()).acceptable, info(Metric::ScaledJacobian).acceptable);
}

/// The worst corner of an element is its last: the part that the first one changes is better than the whole.
TEST(InsideMetric, CountsOfAMovingCornerWhatItChanges) {
  Elements one{ElementKind::Hexahedron, {}};
  std::array<Vec3, 8> bent = kCube;
  bent[6] = {0.45, 0.45, 0.7};
  one.add(bent);
  const auto prepared = input(std::move(one.mesh), Need::QualityOnly);
  const QualityContext context = prepared->quality_context();
  const DefinedJudge judge(defined(inside()), prepared->mesh, ElementFrames{context.geometry, context.normals});
  const auto quality = [&](Index moving) { return judge.quality(0, ElementKind::Hexahedron, bent, {}, moving); };
  const double all = quality(kNoIndex);
  EXPECT_EQ(quality(6), all);
  EXPECT_GT(quality(0), all + 0.1);
  bent[0] = {0.1, 0.05, 0.0};  // another place of the first corner leaves the rest unchanged
  EXPECT_EQ(quality(kNoIndex), all);
}

/// Refusals tell the reason: a target knows a hexahedron's corners alone; a metric field has all of it.
TEST(InsideMetric, HasNoTargetButMetricFields) {
  Progress progress;
  const auto mesh = generate_input("hexahedra 60", progress);
  EXPECT_THROW(require_defined(parse_metric("scaled-jacobian-inside@input"), *mesh), UsageError);
  const auto tetrahedra = generate_input("tetrahedra 60", progress);
  EXPECT_NO_THROW(require_defined(parse_metric("scaled-jacobian-inside@input"), *tetrahedra));
}

}  // namespace
}  // namespace dmoscope::inside_metric_test
