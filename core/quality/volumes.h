#pragma once
// The metrics of volume elements, as formulas.h has those of planar ones: each defined once, for any scalar. V: Vec3Of<scalar>.
//
// Elements are positive as faces.h says. Every value is 1 for the ideal element (edges all alike, corners of a cube), <= 0 for an inverted
// or degenerate one.

#include <array>

#include "core/mesh/corner_tables.h"
#include "core/quality/formulas.h"

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
  /// The same over the corners that change when the one at `moving` moves.
  template <class F>
  DMOSCOPE_ANYWHERE R least_around(Index moving, F f) const {
    R result = scalar::constant<R>(HUGE_VAL);
    for (std::size_t i = 0; i < Corners::kTable.size(); ++i) {
      const CornerTable c = row_of<Corners>(i);
      if (c[0] == moving || c[1] == moving || c[2] == moving || c[3] == moving) result = min(result, corner(i, f));
    }
    return result;
  }
  /// Both.
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

/// One specialisation a metric: tetrahedron(...) and corner<Ideal>(u, v, w, jacobian), whose least over the corners is the value of all
/// other volume elements; where defined. rank_...: see rank().
template <Metric M>
struct SolidFormula;

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

/// 12 (3V)^(2/3) / sum l^2; corner: 3 det(A)^(2/3) / |A|^2. Knupp; the rank is the metric's cube.
template <>
struct SolidFormula<Metric::MeanRatio> {
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    return scalar::ratio(R(12) * signed_two_thirds(scalar::constant<R>(0.5) * t.six_volume), squared_length_sum(t));
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_tetrahedron(const Tetrahedron<V>& t) {
    return RealOf<V>(432) * square_over_cube(t.six_volume, squared_length_sum(t));
  }
  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    return scalar::ratio(R(3) * signed_two_thirds(scalar::constant<R>(Ideal::kDeterminant) * jacobian),
                         squared_norm(Ideal::against_ideal(u, v, w)));
  }
  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    return R(27) * square_over_cube(scalar::constant<R>(Ideal::kDeterminant) * jacobian, squared_norm(Ideal::against_ideal(u, v, w)));
  }
};

/// sign(V) 3 r / R.
template <>
struct SolidFormula<Metric::RadiusRatio> {
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const V n = dot(t.ad, t.ad) * cross(t.ab, t.ac) + dot(t.ac, t.ac) * cross(t.ad, t.ab) + dot(t.ab, t.ab) * cross(t.ac, t.ad);
    return R(6) * scalar::ratio(t.six_volume, twice_surface(t)) * scalar::ratio(abs(t.six_volume), sqrt(dot(n, n)));
  }
};

/// Least dihedral angle over that of the regular tetrahedron.
template <>
struct SolidFormula<Metric::MinAngle> {
  static constexpr double kRegular = 1.2309594173407747;  // arccos(1/3)
  /// Calls f(|e| |six V|, n1 . n2, n1, n2) for every edge e, n1 and n2 the normals of its faces, |n1| |n2| sin = the first; the least.
  template <class V, class F>
  static DMOSCOPE_ANYWHERE RealOf<V> least(const Tetrahedron<V>& t, F f) {
    const RealOf<V> volume = abs(t.six_volume);
    const auto edge = [&](V e, V g, V h) { return f(sqrt(dot(e, e)) * volume, cross(e, g), cross(e, h)); };
    return min(min(min(edge(t.ab, t.ac, t.ad), edge(t.ac, t.ad, t.ab)), min(edge(t.ad, t.ab, t.ac), edge(t.bc, V{} - t.ab, t.bd))),
               min(edge(t.bd, V{} - t.ab, t.bc), edge(t.cd, t.ac, t.bc)));
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const R angle = least(t, [](R sine, V n1, V n2) { return atan2(sine, dot(n1, n2)); });
    return scalar::sign(t.six_volume) * scalar::constant<R>(1.0 / kRegular) * angle;
  }
  /// The tangent of half the angle.
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> rank_tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const R tangent = least(t, [](R sine, V n1, V n2) {
      const R lengths = sqrt(dot(n1, n1)) * sqrt(dot(n2, n2)), cosine = dot(n1, n2);
      return scalar::ratio(sine, lengths + cosine);
    });
    return scalar::sign(t.six_volume) * tangent;
  }
};

/// Tetrahedron: sqrt(2) 6V / largest product of three edges at a corner; else the least corner's determinant of unit edges. Verdict.
template <>
struct SolidFormula<Metric::ScaledJacobian> {
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    const auto l = [](V e) { return sqrt(dot(e, e)); };
    const R ab = l(t.ab), ac = l(t.ac), ad = l(t.ad), bc = l(t.bc), bd = l(t.bd), cd = l(t.cd);
    const R product = scalar::max3(ab * ac * ad, ab * bc * bd, max(ac * bc * cd, ad * bd * cd));
    return scalar::ratio(scalar::constant<R>(std::numbers::sqrt2) * t.six_volume, product);
  }
  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    return scalar::ratio(scalar::constant<R>(Ideal::kSine) * jacobian, sqrt(dot(u, u)) * sqrt(dot(v, v)) * sqrt(dot(w, w)));
  }
};

/// sign(V) 2 sqrt(6) r / l_max. Verdict, inverted.
template <>
struct SolidFormula<Metric::AspectRatio> {
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    using R = RealOf<V>;
    return scalar::ratio(scalar::constant<R>(2.0 * std::numbers::sqrt2 * sqrt3) * t.six_volume, twice_surface(t) * longest_edge(t));
  }
};

/// 3 det(A) / (|A| |adj A|), A the corner's Jacobian against the ideal one, of a tetrahedron the same at every corner. Knupp.
template <>
struct SolidFormula<Metric::Condition> {
  template <class Ideal, class V>
  static DMOSCOPE_ANYWHERE RealOf<V> corner(V u, V v, V w, RealOf<V> jacobian) {
    using R = RealOf<V>;
    const std::array<V, 3> a = Ideal::against_ideal(u, v, w);
    const R adjoint = squared_norm(std::array<V, 3>{cross(a[0], a[1]), cross(a[1], a[2]), cross(a[2], a[0])});
    return scalar::ratio(scalar::constant<R>(3.0 * Ideal::kDeterminant) * jacobian, sqrt(squared_norm(a)) * sqrt(adjoint));
  }
  template <class V>
  static DMOSCOPE_ANYWHERE RealOf<V> tetrahedron(const Tetrahedron<V>& t) {
    return corner<TetrahedronCorner>(t.ab, t.ac, t.ad, t.six_volume);
  }
};

template <Metric M>
inline constexpr bool kDefinedForTetrahedra = requires(const Tetrahedron<Vec3Of<double>>& t) {
  SolidFormula<M>::tetrahedron(t);
};
/// For hexahedra, wedges and pyramids?
template <Metric M>
inline constexpr bool kDefinedForCorners = requires(Vec3Of<double> v) {
  SolidFormula<M>::template corner<CubeCorner>(v, v, v, 0.0);
};

template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> metric(const Tetrahedron<V>& t) {
  return SolidFormula<M>::tetrahedron(t);
}
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> metric(const CorneredSolid<V, Ideal, N, Corners>& s) {
  return s.least([](V u, V v, V w, RealOf<V> jacobian) { return SolidFormula<M>::template corner<Ideal>(u, v, w, jacobian); });
}

/// metric() and metric_around() in one.
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE WholeAndAround<RealOf<V>> metric_whole_and_around(const CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  return s.least_whole_and_around(
      moving, [](V u, V v, V w, RealOf<V> jacobian) { return SolidFormula<M>::template corner<Ideal>(u, v, w, jacobian); });
}
/// The same for shapes that are judged as a whole.
template <Metric M, class Shape>
DMOSCOPE_ANYWHERE auto metric_whole_and_around(const Shape& shape, Index /*moving*/) {
  const auto value = metric<M>(shape);
  return WholeAndAround<std::remove_cv_t<decltype(value)>>{value, value};
}

/// See formulas.h.
template <Metric M, class V>
DMOSCOPE_ANYWHERE RealOf<V> rank(const Tetrahedron<V>& t) {
  if constexpr (requires { SolidFormula<M>::rank_tetrahedron(t); })
    return SolidFormula<M>::rank_tetrahedron(t);
  else
    return metric<M>(t);
}

template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> metric_around(const CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  return s.least_around(moving,
                        [](V u, V v, V w, RealOf<V> jacobian) { return SolidFormula<M>::template corner<Ideal>(u, v, w, jacobian); });
}
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
DMOSCOPE_ANYWHERE RealOf<V> rank_around(const CorneredSolid<V, Ideal, N, Corners>& s, Index moving) {
  if constexpr (M == Metric::MeanRatio)
    return s.least_around(
        moving, [](V u, V v, V w, RealOf<V> jacobian) { return SolidFormula<M>::template rank_corner<Ideal>(u, v, w, jacobian); });
  else
    return metric_around<M>(s, moving);
}

/// Calls f.template operator()<M>() with a metric that is defined for some volume element; with MeanRatio for any other.
template <class F>
DMOSCOPE_INLINE DMOSCOPE_ANYWHERE decltype(auto) with_volume_metric(Metric metric, F&& f) {
  switch (metric) {
    case Metric::RadiusRatio:
      return f.template operator()<Metric::RadiusRatio>();
    case Metric::MinAngle:
      return f.template operator()<Metric::MinAngle>();
    case Metric::ScaledJacobian:
      return f.template operator()<Metric::ScaledJacobian>();
    case Metric::AspectRatio:
      return f.template operator()<Metric::AspectRatio>();
    case Metric::Condition:
      return f.template operator()<Metric::Condition>();
    default:
#if !defined(__CUDA_ARCH__)
      if (!is_built_in(metric)) refuse_defined_metric();
#endif
      return f.template operator()<Metric::MeanRatio>();
  }
}

}  // namespace dmoscope::formulas
