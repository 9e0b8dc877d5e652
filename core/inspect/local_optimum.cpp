// The best place for a vertex among triangles by the mean ratio. Like the search's threshold rounds, it uses that each element's quality is
// N(p) / S(p) with N affine and S quadratic, so that at the maximum of the least N - t S every quality can exceed t. S grows with |p|^2
// equally for all elements, so the maximum is that of a paraboloid among planes, which one, two or three of them decide. Raising t to the
// least quality there and repeating converges faster than linearly to the exact maximum, since the places with a quality above t form an
// intersection of discs.

#include <algorithm>
#include <array>

#include "core/inspect/quality_field.h"
#include "core/inspect/require_star.h"
#include "core/quality/element_shape.h"
#include "core/search/mesh_star.h"
#include "core/search/ratio_form.h"

namespace dmoscope {

namespace {

using V = Vec2<double>;
using Forms = std::vector<RatioForm<double>>;

constexpr int kRounds = 200;

V scaled(double s, V a) { return {s * a.x, s * a.y}; }

/// The maximum of min_k (a_k + b_k . p) - c |p|^2.
class Paraboloid {
 public:
  Paraboloid(const Forms& forms, double t) : c_(2.0 * t) {
    for (const RatioForm<double>& f : forms) planes_.push_back({f.n0 - t * f.s0, {f.nx - t * f.sx, f.ny - t * f.sy}});
  }

  /// Finds the maximum: adds the plane that is lowest at the maximum of a few others until it is one of those.
  [[nodiscard]] V highest() const {
    Few few{{0}, 1};
    V place = of_one(0);
    double value = value_at(few, place);
    for (std::size_t i = 0; i < 20 * planes_.size() + 100; ++i) {
      const std::size_t lowest = lowest_at(place);
      if (!(plane_at(lowest, place) < value + c_ * dot(place, place))) break;
      Few more = few;
      more.planes[more.count++] = lowest;
      const double before = value;
      few = decisive(more, place, value);
      if (!(value < before)) break;
    }
    return place;
  }

 private:
  struct Plane {
    double a;
    V b;
  };
  struct Few {
    std::array<std::size_t, 4> planes;
    std::size_t count;
  };

  [[nodiscard]] double plane_at(std::size_t k, V p) const { return planes_[k].a + dot(planes_[k].b, p); }
  [[nodiscard]] std::size_t lowest_at(V p) const {
    std::size_t lowest = 0;
    for (std::size_t k = 1; k < planes_.size(); ++k)
      if (plane_at(k, p) < plane_at(lowest, p)) lowest = k;
    return lowest;
  }
  [[nodiscard]] double value_at(const Few& few, V p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < few.count; ++i) least = std::min(least, plane_at(few.planes[i], p));
    return least - c_ * dot(p, p);
  }

  [[nodiscard]] V of_one(std::size_t k) const { return scaled(0.5 / c_, planes_[k].b); }
  /// Maximum on the line where both planes are equal.
  [[nodiscard]] V of_two(std::size_t i, std::size_t k) const {
    const V d = planes_[i].b - planes_[k].b;
    const double square = dot(d, d);
    if (!(square > 0.0)) return of_one(i);
    const double share = -(2.0 * c_ * (planes_[i].a - planes_[k].a) + dot(d, planes_[k].b)) / square;
    return scaled(0.5 / c_, planes_[k].b + scaled(share, d));
  }
  /// Place where all three planes are equal.
  [[nodiscard]] V of_three(std::size_t i, std::size_t j, std::size_t k) const {
    const V d = planes_[j].b - planes_[i].b, e = planes_[k].b - planes_[i].b;
    const double p = planes_[i].a - planes_[j].a, q = planes_[i].a - planes_[k].a, area = cross(d, e);
    if (area == 0.0) return of_two(i, j);
    return {(p * e.y - q * d.y) / area, (d.x * q - e.x * p) / area};
  }

  /// Finds those of up to four planes that decide their maximum; sets its place and value. Any place is a lower bound of the maximum, and
  /// that of the right planes attains it, so the best of all is the maximum.
  [[nodiscard]] Few decisive(const Few& from, V& place, double& value) const {
    Few best{};
    value = -std::numeric_limits<double>::infinity();
    const auto offer = [&](const Few& few, V p) {
      const double v = value_at(from, p);
      if (v > value) best = few, place = p, value = v;
    };
    const auto& f = from.planes;
    for (std::size_t i = 0; i < from.count; ++i) {
      offer({{f[i]}, 1}, of_one(f[i]));
      for (std::size_t j = 0; j < i; ++j) {
        offer({{f[i], f[j]}, 2}, of_two(f[i], f[j]));
        for (std::size_t k = 0; k < j; ++k) offer({{f[i], f[j], f[k]}, 3}, of_three(f[i], f[j], f[k]));
      }
    }
    return best;
  }

  double c_;
  std::vector<Plane> planes_;
};

double least_quality(const Star<double>& star, V p) {
  double least = std::numeric_limits<double>::infinity();
  for (const StarTriangle<double>& t : star.triangles)
    least = std::min(least, evaluate<Metric::MeanRatio>(formulas::Triangle<V>(p, t.b, t.c)));
  return least;
}

/// A place with a positive least quality, if there is one above 1e-9.
std::optional<V> valid_place(const Star<double>& star, const Forms& forms) {
  if (least_quality(star, {}) > 0.0) return V{};
  for (const double t : {1e-2, 1e-4, 1e-6, 1e-9}) {
    const V p = Paraboloid(forms, t).highest();
    if (least_quality(star, p) > 0.0) return p;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LocalOptimum> local_optimum(const InputMesh& input, PositionView positions, Metric metric, Index vertex) {
  require_vertex(input, vertex);
  if (metric != Metric::MeanRatio && metric != Metric::MeanRatioArea) return std::nullopt;  // both agree for triangles
  if (input.topology.star(vertex).empty()) return std::nullopt;
  Star<double> star;
  gather_star(MeshStar<Plane>(input.planar_view(), positions, vertex), star);
  if (!star.quadrilaterals.empty()) return std::nullopt;
  Forms forms(star.triangles.size());
  for (std::size_t k = 0; k < forms.size(); ++k) triangle_form(star.triangles[k], forms[k]);
  const std::optional<V> start = valid_place(star, forms);
  if (!start) return std::nullopt;
  V place = *start;
  double quality = least_quality(star, place);
  for (int round = 0; round < kRounds; ++round) {
    const V next = Paraboloid(forms, quality).highest();
    const double there = least_quality(star, next);
    if (!(there > quality)) break;
    place = next;
    quality = there;
  }
  return LocalOptimum{scaled(star.scale, place), quality};
}

}  // namespace dmoscope
