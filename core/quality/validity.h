#pragma once
// Is an element valid: is its Jacobian determinant positive everywhere in it, not only at its corners?
//
// Triangles, planar quadrilaterals, tetrahedra and pyramids are when they are at their corners. The determinant of a trilinear hexahedron
// is a polynomial of degree 2 in each of its three coordinates; no value of it in a box is less than the least of its Bernstein
// coefficients there, of which those at the box's corners are values (Johnen, Remacle, Geuzaine: Geometrical validity of curvilinear finite
// elements, JCP 2013). A piece of which neither tells enough is halved. A wedge's is linear across and quadratic along its axis: its least
// value stands on one of the three lines between the triangles. Everything is in double with a bound of what rounding may add, so that
// "valid" is proved.

#include <array>
#include <cstdint>

#include "core/base/host_device.h"
#include "core/mesh/mesh.h"
#include "core/quality/volumes.h"

namespace dmoscope {

/// The answer to whether a determinant is positive everywhere in an element, and where not.
struct Validity {
  bool proved = false;  // it is positive everywhere
  double least = 0.0;   // where it is not proved: a value that is not positive, over the cube of the longest edge; 0: undecided
  Vec3 at{};            // and where, in the element's own coordinates, each in [0, 1]: of the corner with the lowest number
};

namespace validity {

/// Bound of the rounding error of a coefficient, where the absolute coordinates of each edge add up to at most 1: differences, scaling, a
/// determinant, and a mean of up to eight determinants.
inline constexpr double kRounding = 0x1p-46;

[[nodiscard]] DMOSCOPE_ANYWHERE double sum_of_sizes(Vec3 a) {
  using scalar::abs;
  return abs(a.x) + abs(a.y) + abs(a.z);
}
/// 1 / the longest of these, by sums of absolute coordinates.
template <std::size_t N>
[[nodiscard]] DMOSCOPE_ANYWHERE double scale_of(const std::array<Vec3, N>& edges) {
  double longest = 0.0;
  for (const Vec3& edge : edges) longest = scalar::max(longest, sum_of_sizes(edge));
  return 1.0 / longest;
}

/// Coefficients of Bernstein polynomials of degree 2 in three coordinates: (p, q, r) at 9 p + 3 q + r.
using Coefficients = std::array<double, 27>;

/// Coefficients of a hexahedron's Jacobian determinant over the cube of its longest edge.
[[nodiscard]] DMOSCOPE_ANYWHERE Coefficients coefficients_of(const formulas::Hexahedron<Vec3>& hexahedron) {
  const std::array<Vec3, 8>& p = hexahedron.at;
  // Along each coordinate, by the two others.
  std::array<Vec3, 12> edges{p[1] - p[0], p[2] - p[3], p[5] - p[4], p[6] - p[7], p[3] - p[0], p[2] - p[1],
                             p[7] - p[4], p[6] - p[5], p[4] - p[0], p[5] - p[1], p[7] - p[3], p[6] - p[2]};
  const double scale = scale_of(edges);
  for (Vec3& edge : edges) edge = scale * edge;
  Coefficients sum{};
  for (std::size_t b = 0; b < 4; ++b)
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec3 normal = cross(edges[4 + b], edges[8 + c]);  // b: first coordinate b % 2, third b / 2; c: first c % 2, second c / 2
      for (std::size_t a = 0; a < 4; ++a) {                   // second a % 2, third a / 2
        const std::size_t first = b % 2 + c % 2, second = a % 2 + c / 2, third = a / 2 + b / 2;
        const double weight = (first == 1 ? 0.5 : 1.0) * (second == 1 ? 0.5 : 1.0) * (third == 1 ? 0.5 : 1.0);
        double& here = sum[9 * first + 3 * second + third];
        here = here + weight * dot(edges[a], normal);
      }
    }
  return sum;
}

[[nodiscard]] DMOSCOPE_ANYWHERE bool all_above(const Coefficients& coefficients, double bound) {
  bool above = true;
  for (const double c : coefficients) above = above && c > bound;
  return above;
}

/// A piece of an element, by coefficients over it.
struct Piece {
  Coefficients coefficients;
  Vec3 from;               // its corner with the lowest coordinates
  std::uint32_t cuts = 0;  // along the first coordinate, the second, the third, and so on, each by half
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3 size() const {
    const auto along = [this](std::uint32_t axis) { return 1.0 / static_cast<double>(1U << (cuts + 2 - axis) / 3); };
    return {along(0), along(1), along(2)};
  }
};

/// Halves the piece, which becomes the lower half (de Casteljau).
[[nodiscard]] DMOSCOPE_ANYWHERE Piece upper_half(Piece& piece) {
  const std::uint32_t axis = piece.cuts % 3;
  const std::size_t stride = axis == 0 ? 9 : axis == 1 ? 3 : 1;
  ++piece.cuts;
  Piece upper = piece;
  const Vec3 size = piece.size();
  (axis == 0 ? upper.from.x : axis == 1 ? upper.from.y : upper.from.z) += axis == 0 ? size.x : axis == 1 ? size.y : size.z;
  for (std::size_t line = 0; line < 9; ++line) {
    const std::size_t i = axis == 0 ? line : axis == 1 ? line / 3 * 9 + line % 3 : line * 3;
    const double c0 = piece.coefficients[i], c1 = piece.coefficients[i + stride], c2 = piece.coefficients[i + 2 * stride];
    const double low = 0.5 * (c0 + c1), high = 0.5 * (c1 + c2), middle = 0.5 * (low + high);
    piece.coefficients[i + stride] = low;
    piece.coefficients[i + 2 * stride] = upper.coefficients[i] = middle;
    upper.coefficients[i + stride] = high;
  }
  return upper;
}

/// How often an element is halved, and how many pieces are looked at, before it counts as undecided.
inline constexpr std::uint32_t kMostCuts = 24, kMostPieces = 4096;

/// By pieces; `whole`: coefficients not all of which tell enough.
[[nodiscard]] DMOSCOPE_ANYWHERE Validity divide(const Coefficients& whole) {
  using scalar::abs, scalar::max;
  double greatest = 0.0;
  for (const double c : whole) greatest = max(greatest, abs(c));
  const double bound = kRounding + greatest * 0x1p-46;  // and what halving adds
  std::array<Piece, kMostCuts + 1> waiting;
  waiting[0] = {whole, {}, 0};
  std::uint32_t count = 1;
  for (std::uint32_t looks = 0; count > 0; ++looks) {
    Piece& here = waiting[count - 1];
    const Vec3 size = here.size();
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t i = corner % 2, j = corner / 2 % 2, k = corner / 4;
      const double value = here.coefficients[18 * i + 6 * j + 2 * k];
      const Vec3 to_there{static_cast<double>(i) * size.x, static_cast<double>(j) * size.y, static_cast<double>(k) * size.z};
      if (value <= -bound) return {false, value, here.from + to_there};
    }
    if (all_above(here.coefficients, bound)) {
      --count;
      continue;
    }
    if (here.cuts == kMostCuts || looks == kMostPieces) return {false, 0.0, here.from + 0.5 * size};
    waiting[count] = upper_half(here);
    ++count;
  }
  return {true};
}

}  // namespace validity

[[nodiscard]] DMOSCOPE_ANYWHERE Validity validity_of(const formulas::Hexahedron<Vec3>& hexahedron) {
  const validity::Coefficients whole = validity::coefficients_of(hexahedron);
  if (validity::all_above(whole, validity::kRounding)) return {true};
  return validity::divide(whole);
}

[[nodiscard]] DMOSCOPE_ANYWHERE Validity validity_of(const formulas::Wedge<Vec3>& wedge) {
  const std::array<Vec3, 6>& p = wedge.at;
  std::array<Vec3, 7> edges{p[1] - p[0], p[2] - p[0], p[4] - p[3], p[5] - p[3], p[3] - p[0], p[4] - p[1], p[5] - p[2]};
  const double scale = validity::scale_of(edges);
  for (Vec3& edge : edges) edge = scale * edge;
  const Vec3 below = cross(edges[0], edges[1]), above = cross(edges[2], edges[3]),
             between = 0.5 * (cross(edges[0], edges[3]) + cross(edges[2], edges[1]));
  constexpr double kBound = validity::kRounding;
  Validity result{true};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 along = edges[4 + i];
    const double c0 = dot(below, along), c1 = dot(between, along), c2 = dot(above, along);
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

/// May an element of this kind be inverted inside and not at a corner?
[[nodiscard]] constexpr bool has_inside(ElementKind kind) { return kind == ElementKind::Hexahedron || kind == ElementKind::Wedge; }

/// The smallest corner Jacobian of an element that is proved valid; else a number that is not positive: that of a corner, or 0 where the
/// corners are positive and a place inside is not, or is not proved to be. So an element is inverted where this is <= 0.
template <class Shape>
[[nodiscard]] DMOSCOPE_ANYWHERE auto least_jacobian(const Shape& shape) {
  const auto least = formulas::smallest_jacobian(shape);
  if constexpr (requires { validity_of(shape); })
    return least > 0.0 && !validity_of(shape).proved ? 0.0 : least;
  else
    return least;
}

}  // namespace dmoscope
