#pragma once
// Is an element valid: is its Jacobian determinant positive everywhere in it, not only at its corners?
//
// Triangles, quadrilaterals, tetrahedra and pyramids are when they are at their corners (a quadrilateral of a surface is judged against one
// normal, as it looks from there: its determinant is linear along each edge). The determinant of a trilinear hexahedron
// is a polynomial of degree 2 in each of its three coordinates; no value of it in a box is less than the least of its Bernstein
// coefficients there, of which those at the box's corners are values (Johnen, Remacle, Geuzaine: Geometrical validity of curvilinear finite
// elements, JCP 2013). A piece of which neither tells enough is halved. A wedge's is linear across and quadratic along its axis: its least
// value stands on one of the three lines between the triangles. Everything is in double with a bound of what rounding may add, so that
// "valid" is proved.

#include <array>
#include <cstdint>

#include "core/base/host_device.h"
#include "core/mesh/mesh.h"
#include "core/quality/formulas.h"

namespace dmoscope {

/// The answer to whether a determinant is positive everywhere in an element, and where not.
struct Validity {
  bool proved = false;  // it is positive everywhere
  double least = 0.0;   // where it is not proved: a value that is not positive, over the cube of the longest edge; 0: undecided
  Vec3 at{};            // and where, in the element's own coordinates, each in [0, 1]: of the corner with the lowest number
};

namespace validity {

/// Bound of the rounding error of a coefficient, where the absolute coordinates of each edge add up to at most 1. That of a determinant is
/// at most 14 u (u = 2^-53: a difference, a scaling, a sum, and five operations); a hexahedron's coefficient in the middle of an edge has 3
/// of these, of a face 7, of the element 17, and some 50 u of their own: 290 u.
inline constexpr double kRounding = 0x1p-44;

template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R sum_of_sizes(const Vec3Of<R>& a) {
  using scalar::abs;
  return abs(a.x) + abs(a.y) + abs(a.z);
}
/// 1 / the longest of these, by sums of absolute coordinates.
template <class R, std::size_t N>
[[nodiscard]] DMOSCOPE_ANYWHERE R scale_of(const std::array<Vec3Of<R>, N>& edges) {
  using scalar::max;
  R longest = scalar::constant<R>(0.0);
  DMOSCOPE_NO_UNROLL
  for (const Vec3Of<R>& edge : edges) longest = max(longest, sum_of_sizes(edge));
  return scalar::constant<R>(1.0) / longest;
}

/// Coefficients of Bernstein polynomials of degree 2 in three coordinates: (p, q, r) at 9 p + 3 q + r. R: double or a pack of it.
template <class R>
using CoefficientsOf = std::array<R, 27>;
using Coefficients = CoefficientsOf<double>;

/// Coefficients of a hexahedron's Jacobian determinant over the cube of its longest edge. It has no term with squares of two coordinates,
/// so that those at its corners and in the middle of its edges tell the others: see Johnen, Weill, Remacle: Robust and efficient validation
/// of the linear hexahedral element (2017). A device's loops are not unrolled here and below: in registers these numbers would halve the
/// lanes that work at once, while few visits ask for them.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE CoefficientsOf<R> coefficients_of(const formulas::Hexahedron<Vec3Of<R>>& hexahedron) {
  const std::array<Vec3Of<R>, 8>& p = hexahedron.at;
  // Along each coordinate, by the two others, the lower one first.
  std::array<Vec3Of<R>, 12> edges{p[1] - p[0], p[2] - p[3], p[5] - p[4], p[6] - p[7], p[3] - p[0], p[2] - p[1],
                                  p[7] - p[4], p[6] - p[5], p[4] - p[0], p[5] - p[1], p[7] - p[3], p[6] - p[2]};
  const R scale = scale_of(edges);
  DMOSCOPE_NO_UNROLL
  for (Vec3Of<R>& edge : edges) edge = scale * edge;
  const Vec3Of<R>*x = edges.data(), *y = x + 4, *z = y + 4;
  const auto determinant = [](const Vec3Of<R>& a, const Vec3Of<R>& b, const Vec3Of<R>& c) { return dot(a, cross(b, c)); };
  CoefficientsOf<R> at{};
  DMOSCOPE_NO_UNROLL
  for (std::size_t i = 0; i < 2; ++i) {
    DMOSCOPE_NO_UNROLL
    for (std::size_t j = 0; j < 2; ++j) {
      DMOSCOPE_NO_UNROLL
      for (std::size_t k = 0; k < 2; ++k) at[18 * i + 6 * j + 2 * k] = determinant(x[j + 2 * k], y[i + 2 * k], z[i + 2 * j]);
    }
  }
  const R half = scalar::constant<R>(0.5), quarter = scalar::constant<R>(0.25);
  DMOSCOPE_NO_UNROLL
  for (std::size_t a = 0; a < 2; ++a) {
    DMOSCOPE_NO_UNROLL
    for (std::size_t b = 0; b < 2; ++b) {
      const std::size_t along_x = 9 + 6 * a + 2 * b, along_y = 18 * a + 3 + 2 * b, along_z = 18 * a + 6 * b + 1;
      const auto middle = [&](std::size_t i, std::size_t step, R of_sums) { at[i] = half * (of_sums - at[i - step] - at[i + step]); };
      middle(along_x, 9, determinant(x[a + 2 * b], y[2 * b] + y[1 + 2 * b], z[2 * a] + z[1 + 2 * a]));
      middle(along_y, 3, determinant(x[2 * b] + x[1 + 2 * b], y[a + 2 * b], z[a] + z[a + 2]));
      middle(along_z, 1, determinant(x[b] + x[b + 2], y[a] + y[a + 2], z[a + 2 * b]));
    }
  }
  const auto middle_of_face = [&](std::size_t i, std::size_t step, std::size_t other) {
    at[i] = half * (at[i - step] + at[i + step] + at[i - other] + at[i + other]) -
            quarter * (at[i - step - other] + at[i - step + other] + at[i + step - other] + at[i + step + other]);
  };
  DMOSCOPE_NO_UNROLL
  for (std::size_t i = 0; i < 2; ++i) {
    middle_of_face(12 + 2 * i, 9, 3);
    middle_of_face(10 + 6 * i, 9, 1);
    middle_of_face(4 + 18 * i, 3, 1);
  }
  middle_of_face(13, 9, 3);
  return at;
}

[[nodiscard]] DMOSCOPE_ANYWHERE bool all_above(const Coefficients& coefficients, double bound) {
  bool above = true;
  DMOSCOPE_NO_UNROLL
  for (const double c : coefficients) above = above && c > bound;
  return above;
}

/// Coefficients of a wedge's determinant along the three edges between its triangles, where its least value stands: (edge, q) at 3 edge +
/// q.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE std::array<R, 9> coefficients_of(const formulas::Wedge<Vec3Of<R>>& wedge) {
  const std::array<Vec3Of<R>, 6>& p = wedge.at;
  std::array<Vec3Of<R>, 7> edges{p[1] - p[0], p[2] - p[0], p[4] - p[3], p[5] - p[3], p[3] - p[0], p[4] - p[1], p[5] - p[2]};
  const R scale = scale_of(edges);
  for (Vec3Of<R>& edge : edges) edge = scale * edge;
  const Vec3Of<R> below = cross(edges[0], edges[1]), above = cross(edges[2], edges[3]),
                  between = scalar::constant<R>(0.5) * (cross(edges[0], edges[3]) + cross(edges[2], edges[1]));
  return {dot(below, edges[4]), dot(between, edges[4]), dot(above, edges[4]),   dot(below, edges[5]), dot(between, edges[5]),
          dot(above, edges[5]), dot(below, edges[6]),   dot(between, edges[6]), dot(above, edges[6])};
}

/// The least of an element's coefficients: above kRounding it proves the element valid.
template <class Shape>
[[nodiscard]] DMOSCOPE_ANYWHERE auto least_coefficient(const Shape& shape) {
  using scalar::min;
  const auto coefficients = coefficients_of(shape);
  auto least = coefficients[0];
  for (const auto& each : coefficients) least = min(least, each);
  return least;
}

/// A piece of an element: halved `cuts` times, along the first coordinate, the second, the third, and so on; bit c of `upper`: its half of
/// cut c is that of higher coordinates.
struct Piece {
  std::uint32_t cuts = 0, upper = 0;
  /// The coefficients over it, from those over what the last cut halved (de Casteljau).
  DMOSCOPE_ANYWHERE void halve(Coefficients& coefficients, std::uint32_t cut) const {
    const std::size_t stride = cut % 3 == 0 ? 9 : cut % 3 == 1 ? 3 : 1;
    const bool is_upper = (upper >> cut & 1U) != 0;
    DMOSCOPE_NO_UNROLL
    for (std::size_t line = 0; line < 9; ++line) {
      const std::size_t i = stride == 9 ? line : stride == 3 ? line / 3 * 9 + line % 3 : line * 3;
      double &c0 = coefficients[i], &c1 = coefficients[i + stride], &c2 = coefficients[i + 2 * stride];
      const double low = 0.5 * (c0 + c1), high = 0.5 * (c1 + c2);
      c1 = is_upper ? high : low;
      (is_upper ? c0 : c2) = 0.5 * (low + high);
    }
  }
  /// The other half of the last cut that has one to come; false: there is none.
  DMOSCOPE_ANYWHERE bool go_on() {
    while (cuts > 0 && (upper >> (cuts - 1) & 1U) != 0) upper &= ~(1U << --cuts);
    if (cuts == 0) return false;
    upper |= 1U << (cuts - 1);
    return true;
  }
  /// The place with coordinates in it, each in [0, 1].
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 place(Vec3 at) const {
    double along[3] = {at.x, at.y, at.z};
    for (std::uint32_t cut = cuts; cut-- > 0;) along[cut % 3] = 0.5 * (along[cut % 3] + (upper >> cut & 1U));
    return {along[0], along[1], along[2]};
  }
};

/// How often an element is halved, and how many pieces are looked at, before it counts as undecided.
inline constexpr std::uint32_t kMostCuts = 24, kMostPieces = 4096;

/// By pieces; `whole`: coefficients not all of which tell enough. The coefficients over the other half of a piece are found anew from
/// these: to keep those that wait takes more memory than a device's lanes have.
[[nodiscard]] DMOSCOPE_ANYWHERE Validity divide(const Coefficients& whole) {
  using scalar::abs, scalar::max;
  double greatest = 0.0;
  DMOSCOPE_NO_UNROLL
  for (const double c : whole) greatest = max(greatest, abs(c));
  const double bound = kRounding + greatest * 0x1p-46;  // and what halving adds
  Piece piece;
  Coefficients here = whole;
  for (std::uint32_t looks = 0;; ++looks) {
    DMOSCOPE_NO_UNROLL
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t i = corner % 2, j = corner / 2 % 2, k = corner / 4;
      const double value = here[18 * i + 6 * j + 2 * k];
      if (value <= -bound) return {false, value, piece.place({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)})};
    }
    if (all_above(here, bound)) {
      if (!piece.go_on()) return {true};
      here = whole;
      for (std::uint32_t cut = 0; cut < piece.cuts; ++cut) piece.halve(here, cut);
    } else if (piece.cuts == kMostCuts || looks == kMostPieces) {
      return {false, 0.0, piece.place({0.5, 0.5, 0.5})};
    } else {
      piece.halve(here, piece.cuts++);
    }
  }
}

}  // namespace validity

[[nodiscard]] DMOSCOPE_ANYWHERE Validity validity_of(const formulas::Hexahedron<Vec3>& hexahedron) {
  const validity::Coefficients whole = validity::coefficients_of(hexahedron);
  if (validity::all_above(whole, validity::kRounding)) return {true};
  return validity::divide(whole);
}

[[nodiscard]] DMOSCOPE_ANYWHERE Validity validity_of(const formulas::Wedge<Vec3>& wedge) {
  const std::array<double, 9> coefficients = validity::coefficients_of(wedge);
  constexpr double kBound = validity::kRounding;
  Validity result{true};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c0 = coefficients[3 * i], c1 = coefficients[3 * i + 1], c2 = coefficients[3 * i + 2];
    const double low = c0 - kBound, high = c2 - kBound, middle = c1 - kBound;
    if (low > 0.0 && high > 0.0 && (middle >= 0.0 || middle * middle < low * high * (1.0 - 0x1p-40))) continue;
    double t = c0 <= c2 ? 0.0 : 1.0;
    if (const double bend = c0 - 2.0 * c1 + c2; bend > 0.0) t = scalar::min(scalar::max((c0 - c1) / bend, 0.0), 1.0);
    const double value = c0 * ((1.0 - t) * (1.0 - t)) + 2.0 * c1 * (t * (1.0 - t)) + c2 * (t * t);
    const double least = value <= -2.0 * kBound ? value : 0.0;
    if (result.proved || least < result.least) result = {false, least, {i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0, t}};
  }
  return result;
}

/// The place with coordinates in an element: see Validity::at.
[[nodiscard]] inline Vec3 place_in(const formulas::Hexahedron<Vec3>& hexahedron, Vec3 at) {
  const auto& p = hexahedron.at;
  const auto along = [](double t, Vec3 a, Vec3 b) { return (1.0 - t) * a + t * b; };
  const auto layer = [&](std::size_t i) { return along(at.y, along(at.x, p[i], p[i + 1]), along(at.x, p[i + 3], p[i + 2])); };
  return along(at.z, layer(0), layer(4));
}
[[nodiscard]] inline Vec3 place_in(const formulas::Wedge<Vec3>& wedge, Vec3 at) {
  const auto layer = [&](std::size_t i) { return (1.0 - at.x - at.y) * wedge.at[i] + at.x * wedge.at[i + 1] + at.y * wedge.at[i + 2]; };
  return (1.0 - at.z) * layer(0) + at.z * layer(3);
}

/// May an element of this kind be inverted inside and not at a corner?
[[nodiscard]] constexpr bool has_inside(ElementKind kind) { return kind == ElementKind::Hexahedron || kind == ElementKind::Wedge; }

template <class Shape>
inline constexpr bool kHasInside = requires(const Shape& shape) {
  validity_of(shape);
};

/// The smallest corner Jacobian of an element that is proved valid; else a number that is not positive: that of a corner, or 0 where the
/// corners are positive and a place inside is not, or is not proved to be. So an element is inverted where this is <= 0.
template <class Shape>
[[nodiscard]] DMOSCOPE_ANYWHERE auto least_jacobian(const Shape& shape) {
  const auto least = formulas::smallest_jacobian(shape);
  if constexpr (kHasInside<Shape>)
    return least > 0.0 && !validity_of(shape).proved ? 0.0 : least;
  else
    return least;
}

}  // namespace dmoscope
