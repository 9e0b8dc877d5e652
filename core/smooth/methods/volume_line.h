#pragma once
// Values of the corners of a volume's star with its vertex on a line, and the place on it where the least of them is largest.
//
// With the vertex at t along the line the determinant J of a corner's three edges is a t + b, also where all of them move, since two that
// move alike cancel. The edges against the ideal corner, A, are affine in t, so that |A|^2 is c t^2 + e t + f and |A|^3 convex: J / |A|^3,
// which rises with the mean ratio, is worth some constant or more on one stretch of the line alone. The least of such functions is like
// that, too: it rises to its maximum and falls from there on, and its slope at some t tells which of the two it does there.

#include <algorithm>
#include <span>
#include <vector>

#include "core/numeric/dual.h"
#include "core/search/untangling.h"
#include "core/smooth/visit/star_pieces.h"

namespace dmoscope {

/// Corner, or tetrahedron, on the line.
struct LineCorner {
  double a, b;                    // its determinant against the ideal corner's, a t + b
  double c, e, f;                 // |A|^2
  double jacobian_a, jacobian_b;  // its Jacobian over the reference measure

  [[nodiscard]] double determinant(double t) const { return a * t + b; }
  [[nodiscard]] double jacobian(double t) const { return jacobian_a * t + jacobian_b; }
  /// Rank of the corner, which rises with the mean ratio, where that is positive.
  [[nodiscard]] double rank(double t) const {
    const double n = determinant(t), s = (c * t + e) * t + f, inverse = 1.0 / s, part = n * inverse;
    return part * part * inverse;
  }
  /// Slope of the rank, times a positive number.
  [[nodiscard]] double rank_slope(double t) const {
    const double s = (c * t + e) * t + f;
    return a * s - 1.5 * determinant(t) * (2.0 * c * t + e);
  }
};

struct LineStretch {
  double low, high;
};

namespace volume_line {

/// Cuts off the part where a t + b <= 0. It must be positive somewhere in the stretch.
inline void keep_positive(LineStretch& stretch, double a, double b) {
  if (a > 0.0) stretch.low = std::max(stretch.low, -b / a);
  if (a < 0.0) stretch.high = std::min(stretch.high, -b / a);
}

/// Returns the t between low and high at which a function that rises and then falls is largest. slope(t): positive where it rises.
template <class Slope>
double top(LineStretch stretch, const Slope& slope) {
  constexpr int kHalvings = 60;
  constexpr double kFine = 1e-12;  // share of the star's size
  auto [low, high] = stretch;
  for (int i = 0; i < kHalvings && high - low > kFine; ++i) {
    const double middle = low + 0.5 * (high - low), rise = slope(middle);
    if (rise == 0.0) return middle;
    (rise > 0.0 ? low : high) = middle;
  }
  return low + 0.5 * (high - low);
}

/// Slope at t of the least of the functions value(corner, t).
template <class Value, class Slope>
double slope_of_least(std::span<const LineCorner> corners, double t, const Value& value, const Slope& slope) {
  const LineCorner* least = nullptr;
  double least_value = HUGE_VAL;
  for (const LineCorner& corner : corners)
    if (const double here = value(corner, t); here < least_value) least = &corner, least_value = here;
  return least != nullptr ? slope(*least, t) : 0.0;
}

}  // namespace volume_line

/// Fills `out` with the corners that change along the line through the star's vertex, of direction d.
inline void corners_on_line(const VolumeStar<double>& star, Vec3 d, std::vector<LineCorner>& out) {
  using V = Vec3Of<LineDual>;
  out.clear();
  const auto take = [&out]<class Ideal>(V u, V v, V w, LineDual jacobian, double reference) {
    const auto edges = Ideal::against_ideal(u, v, w);
    const LineDual square = formulas::squared_norm(edges);
    double c = 0.0;
    for (const V& edge : edges) c += edge.x.by * edge.x.by + edge.y.by * edge.y.by + edge.z.by * edge.z.by;
    out.push_back({Ideal::kDeterminant * jacobian.by, Ideal::kDeterminant * jacobian.value, c, square.by, square.value,
                   jacobian.by / reference, jacobian.value / reference});
  };
  star_pieces::for_solids<true>(
      star, V{{0.0, d.x}, {0.0, d.y}, {0.0, d.z}},
      [&take](const formulas::Tetrahedron<V>& t, double reference) {
        take.template operator()<formulas::TetrahedronCorner>(t.ab, t.ac, t.ad, t.six_volume, reference);
      },
      take);
}

[[nodiscard]] inline double least_jacobian(std::span<const LineCorner> corners, double t) {
  double least = HUGE_VAL;
  for (const LineCorner& corner : corners) least = std::min(least, corner.jacobian(t));
  return least;
}

/// Place where the least mean ratio is largest, on the stretch of the line on which no corner is inverted; there must be one.
[[nodiscard]] inline double best_rank(std::span<const LineCorner> corners, LineStretch reach) {
  for (const LineCorner& corner : corners) volume_line::keep_positive(reach, corner.a, corner.b);
  return volume_line::top(reach, [corners](double t) {
    return volume_line::slope_of_least(
        corners, t, [](const LineCorner& q, double at) { return q.rank(at); },
        [](const LineCorner& q, double at) { return q.rank_slope(at); });
  });
}

/// Place where the least Jacobian over its reference measure is largest.
[[nodiscard]] inline double best_jacobian(std::span<const LineCorner> corners, LineStretch reach) {
  return volume_line::top(reach, [corners](double t) {
    return volume_line::slope_of_least(
        corners, t, [](const LineCorner& q, double at) { return q.jacobian(at); },
        [](const LineCorner& q, double /*at*/) { return q.jacobian_a; });
  });
}

/// Place where the mean is largest that counts while elements are inverted, see UntanglingMean, a sum of concave functions. The least
/// Jacobian does not fall below its value at 0.
[[nodiscard]] inline double best_untangling(std::span<const LineCorner> corners, LineStretch reach) {
  const double floor = least_jacobian(corners, 0.0);
  for (const LineCorner& corner : corners) volume_line::keep_positive(reach, corner.jacobian_a, corner.jacobian_b - floor);
  constexpr double kInside = 1.0 - 1e-9;  // at the stretch's ends rounding could put the least below
  return kInside * volume_line::top(reach, [corners](double t) {
           double slope = 0.0;
           for (const LineCorner& corner : corners)
             if (corner.jacobian(t) < UntanglingMean::kEnough) slope += corner.jacobian_a;
           return slope;
         });
}

}  // namespace dmoscope
