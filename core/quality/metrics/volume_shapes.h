#pragma once
// The shapes of volume elements as metrics see them. V: Vec3Of<scalar>. Elements are positive as
// faces.h says.

#include <array>

#include "core/mesh/corner_tables.h"
#include "core/quality/metrics/planar_shapes.h"

namespace dmoscope::formulas {

template <class V>
[[nodiscard]] DMOSCOPE_ANYWHERE RealOf<V> determinant(V u, V v, V w) {
  return dot(cross(u, v), w);
}

/// Edge vectors and six times the signed volume of the tetrahedron a, b, c, d.
template <class V>
struct Tetrahedron {
  V ab, ac, ad, bc, bd, cd;
  RealOf<V> six_volume;
  DMOSCOPE_ANYWHERE Tetrahedron(V a, V b, V c, V d)
      : ab(b - a), ac(c - a), ad(d - a), bc(c - b), bd(d - b), cd(d - c), six_volume(determinant(b - a, c - a, d - a)) {}
};

/// A corner of the ideal element, of which three edges leave at right angles: a cube's.
struct CubeCorner {
  static constexpr double kDeterminant = 1.0;  // of A where that of the edges is 1
  static constexpr double kSine = 1.0;         // 1 over the determinant of the ideal corner's unit edges
  template <class V>
  static DMOSCOPE_ANYWHERE std::array<V, 3> against_ideal(V u, V v, V w) {
    return {u, v, w};
  }
};
/// u and v at 60 degrees, w upright: of a wedge with equal edges.
struct PrismCorner {
  static constexpr double kDeterminant = 2.0 / sqrt3, kSine = 2.0 / sqrt3;
  template <class V>
  static DMOSCOPE_ANYWHERE std::array<V, 3> against_ideal(V u, V v, V w) {
    return {u, scalar::constant<RealOf<V>>(1.0 / sqrt3) * (v + v - u), w};
  }
};
/// u and v of a square, w to the tip of a pyramid with equal edges.
struct PyramidCorner {
  static constexpr double kDeterminant = std::numbers::sqrt2, kSine = std::numbers::sqrt2;
  template <class V>
  static DMOSCOPE_ANYWHERE std::array<V, 3> against_ideal(V u, V v, V w) {
    return {u, v, scalar::constant<RealOf<V>>(0.5 * std::numbers::sqrt2) * (w + w - u - v)};
  }
};
/// A corner of the tetrahedron with equal edges.
struct TetrahedronCorner {
  static constexpr double kDeterminant = std::numbers::sqrt2;
  template <class V>
  static DMOSCOPE_ANYWHERE std::array<V, 3> against_ideal(V u, V v, V w) {
    using R = RealOf<V>;
    return {u, scalar::constant<R>(1.0 / sqrt3) * (v + v - u),
            scalar::constant<R>(0.5 * std::numbers::sqrt2 / sqrt3) * (w + w + w - u - v) + V{}};
  }
};

/// One row of a table of corners: the corner and the ends of its three edges. Always inlined: code for different processors shares it, and
/// must not share one compiled copy.
template <class Corners>
[[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE CornerTable row_of(std::size_t i) {
#if defined(__CUDA_ARCH__)
  constexpr auto table = Corners::kTable;  // a device knows the table's content, not its place
  return table[i];
#else
  return Corners::kTable[i];
#endif
}

/// A value of a whole element, and of what of it changes with one of its corners.
template <class R>
struct WholeAndAround {
  R whole, around;
};

/// An element that is judged corner by corner. Corners: a table of each corner and the ends of its three edges, right-handed. A pyramid's
/// tip, where four edges meet, is in the corners of its base.
template <class V, class Ideal, std::size_t N, class Corners>
struct CorneredSolid {
  using R = RealOf<V>;
  std::array<V, N> at;

  /// Least of f(u, v, w, u x v . w) over the corners.
  template <class F>
  DMOSCOPE_ANYWHERE R least(F f) const {
    R result = corner(0, f);
    for (std::size_t i = 1; i < Corners::kTable.size(); ++i) result = min(result, corner(i, f));
    return result;
  }
  /// Least of f over the corners that change when the one at `moving` moves.
  template <class F>
  DMOSCOPE_ANYWHERE R least_around(Index moving, F f) const {
    R result = scalar::constant<R>(HUGE_VAL);
    for (std::size_t i = 0; i < Corners::kTable.size(); ++i) {
      const CornerTable c = row_of<Corners>(i);
      if (c[0] == moving || c[1] == moving || c[2] == moving || c[3] == moving) result = min(result, corner(i, f));
    }
    return result;
  }
  /// least() and least_around() in one pass.
  template <class F>
  DMOSCOPE_ANYWHERE WholeAndAround<R> least_whole_and_around(Index moving, F f) const {
    WholeAndAround<R> result{scalar::constant<R>(HUGE_VAL), scalar::constant<R>(HUGE_VAL)};
    for (std::size_t i = 0; i < Corners::kTable.size(); ++i) {
      const CornerTable c = row_of<Corners>(i);
      const R value = corner(i, f);
      result.whole = min(result.whole, value);
      if (c[0] == moving || c[1] == moving || c[2] == moving || c[3] == moving) result.around = min(result.around, value);
    }
    return result;
  }

 private:
  template <class F>
  [[gnu::always_inline]] DMOSCOPE_ANYWHERE R corner(std::size_t i, F f) const {
    const CornerTable c = row_of<Corners>(i);
    const V u = at[c[1]] - at[c[0]], v = at[c[2]] - at[c[0]], w = at[c[3]] - at[c[0]];
    return f(u, v, w, determinant(u, v, w));
  }
};

struct HexahedronCorners {
  static constexpr std::array<CornerTable, 8> kTable = kHexahedronCorners;
};
struct WedgeCorners {
  static constexpr std::array<CornerTable, 6> kTable = kWedgeCorners;
};
struct PyramidCorners {
  static constexpr std::array<CornerTable, 4> kTable = kPyramidCorners;
};

template <class V>
using Hexahedron = CorneredSolid<V, CubeCorner, 8, HexahedronCorners>;
template <class V>
using Wedge = CorneredSolid<V, PrismCorner, 6, WedgeCorners>;
template <class V>
using Pyramid = CorneredSolid<V, PyramidCorner, 5, PyramidCorners>;

/// Smallest signed corner Jacobian, in cubic units: six times the volume of the corner's tetrahedron. Inverted means <= 0.
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> smallest_jacobian(const Tetrahedron<V>& t) {
  return t.six_volume;
}
template <class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> smallest_jacobian(const CorneredSolid<V, Ideal, N, Corners>& s) {
  return s.least([](V, V, V, RealOf<V> jacobian) { return jacobian; });
}

template <class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> smallest_jacobian_around(const CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  return s.least_around(moving, [](V, V, V, RealOf<V> jacobian) { return jacobian; });
}

template <class V>
DMOSCOPE_ANYWHERE RealOf<V> squared_length_sum(const Tetrahedron<V>& t) {
  return dot(t.ab, t.ab) + dot(t.ac, t.ac) + dot(t.ad, t.ad) + dot(t.bc, t.bc) + dot(t.bd, t.bd) + dot(t.cd, t.cd);
}
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> squared_norm(const std::array<V, 3>& a) {
  return dot(a[0], a[0]) + dot(a[1], a[1]) + dot(a[2], a[2]);
}
/// sign(a) |a|^(2/3).
template <class R>
DMOSCOPE_ANYWHERE R signed_two_thirds(R a) {
  using scalar::cube_root;
  const R root = cube_root(a);
  return root * abs(root);
}
/// a |a| / b^3, so that no power over- or underflows where a is about b^(3/2).
template <class R>
DMOSCOPE_ANYWHERE R square_over_cube(R a, R b) {
  const R inverse = scalar::ratio(R(1), b), part = a * inverse;
  return part * abs(part) * inverse;
}
/// Twice the sum of the areas of the faces.
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> twice_surface(const Tetrahedron<V>& t) {
  const auto twice_area = [](V u, V v) {
    const V n = cross(u, v);
    return sqrt(dot(n, n));
  };
  return (twice_area(t.ab, t.ac) + twice_area(t.ac, t.ad)) + (twice_area(t.ad, t.ab) + twice_area(t.bc, t.bd));
}
template <class V>
DMOSCOPE_ANYWHERE RealOf<V> longest_edge(const Tetrahedron<V>& t) {
  const auto squared =
      scalar::max3(scalar::max3(dot(t.ab, t.ab), dot(t.ac, t.ac), dot(t.ad, t.ad)), dot(t.bc, t.bc), max(dot(t.bd, t.bd), dot(t.cd, t.cd)));
  return sqrt(squared);
}

}  // namespace dmoscope::formulas
