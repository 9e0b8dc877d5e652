#pragma once
// Mean ratio of tetrahedra that have targets: forms (see volume_form.h) of J = K A W^-1, whose columns are sums of the corners' places
// times numbers of the target.
//
// Turning J or W^-1 changes nothing, so W^-1 may be lower triangular and K upper triangular; and neither does their size, so that their
// determinants are 1.

#include <cstddef>

#include "core/base/host_device.h"
#include "core/quality/formulas.h"
#include "core/smooth/kernels/volume_form.h"

namespace dmoscope::volumes {

/// Number of numbers that the target of a tetrahedron has in memory: W^-1 (g11, g21, g22, g31, g32, g33), and where any is crossed K (k11,
/// k12, k13, k22, k23, k33).
[[nodiscard]] constexpr std::size_t solid_target_numbers(bool crossed) { return crossed ? 12 : 6; }

/// Matrix K.
template <class R>
struct Stretch {
  R k11, k12, k13, k22, k23, k33;
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<R> operator()(Vec3Of<R> a) const {
    return {k11 * a.x + k12 * a.y + k13 * a.z, k22 * a.y + k23 * a.z, k33 * a.z};
  }
  /// Product with the transposed matrix.
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<R> back(Vec3Of<R> a) const {
    return {k11 * a.x, k12 * a.x + k22 * a.y, k13 * a.x + k23 * a.y + k33 * a.z};
  }
};

/// Form of a stretched tetrahedron, like MeanRatioForm, but s has six terms of second order.
template <class R>
struct StretchedForm {
  R v0, vx, vy, vz;
  R s0, sx, sy, sz;
  R xx, yy, zz, xy, xz, yz;
};
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE F determinant_of(const StretchedForm<R>& f, const Vec3Of<F>& p) {
  return F(f.v0) + F(f.vx) * p.x + F(f.vy) * p.y + F(f.vz) * p.z;
}
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE F squares_of(const StretchedForm<R>& f, const Vec3Of<F>& p, F /*square*/) {
  return F(f.s0) + (F(f.sx) + F(f.xx) * p.x + F(f.xy) * p.y + F(f.xz) * p.z) * p.x + (F(f.sy) + F(f.yy) * p.y + F(f.yz) * p.z) * p.y +
         (F(f.sz) + F(f.zz) * p.z) * p.z;
}
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<F> slope_of_squares(const StretchedForm<R>& f, const Vec3Of<F>& p) {
  const F two(2);
  return {F(f.sx) + two * F(f.xx) * p.x + F(f.xy) * p.y + F(f.xz) * p.z, F(f.sy) + F(f.xy) * p.x + two * F(f.yy) * p.y + F(f.yz) * p.z,
          F(f.sz) + F(f.xz) * p.x + F(f.yz) * p.y + two * F(f.zz) * p.z};
}
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE F rank_of(const StretchedForm<R>& f, const Vec3Of<F>& p, F square) {
  return formulas::square_over_cube(determinant_of(f, p), squares_of(f, p, square));
}

/// Greatest value of the terms of second order where |x| and so on are not larger than these; `square`: the sum of their squares.
template <class F>
[[nodiscard]] DMOSCOPE_ANYWHERE F second_order_bound(const MeanRatioForm<F>& f, F /*x*/, F /*y*/, F /*z*/, F square) {
  return f.square * square;
}
template <class F>
[[nodiscard]] DMOSCOPE_ANYWHERE F second_order_bound(const StretchedForm<F>& f, F x, F y, F z, F /*square*/) {
  using scalar::abs;
  return f.xx * x * x + f.yy * y * y + f.zz * z * z + abs(f.xy) * x * y + abs(f.xz) * x * z + abs(f.yz) * y * z;
}

/// Tetrahedron and its target: the places b, c, d of the other corners, and each one's three numbers of W^-1: a row of it, or for the
/// element's first corner the negative of their sum.
template <class R>
struct TargetTetrahedron {
  Vec3Of<R> at[3], rows[3];
  Stretch<R> stretch;

  /// Column `m` of A W^-1 with the vertex at the origin.
  template <class Component>
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<R> column(Component component) const {
    return component(rows[0]) * at[0] + component(rows[1]) * at[1] + component(rows[2]) * at[2];
  }
};

/// Unit of rank, sqrt(27): the rank of an element is (3 v^(2/3) / s)^3.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R unit_of_rank() {
  return scalar::constant<R>(5.196152422706632);
}

/// Form of the tetrahedron.
template <bool Crossed, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE auto target_form(const TargetTetrahedron<R>& t) {
  using Point = Vec3Of<R>;
  const Point &b = t.at[0], &c = t.at[1], &d = t.at[2];
  const R unit = unit_of_rank<R>(), less = R(0) - unit;
  const Point n = cross(b, c) + cross(c, d) + cross(d, b);
  const Point shares = t.rows[0] + t.rows[1] + t.rows[2];  // shares of the vertex's place in the columns, by which these are less
  Point columns[3] = {t.column([](const Point& row) { return row.x; }), t.column([](const Point& row) { return row.y; }),
                      t.column([](const Point& row) { return row.z; })};
  if constexpr (Crossed)
    for (Point& column : columns) column = t.stretch(column);
  const R squares = dot(columns[0], columns[0]) + dot(columns[1], columns[1]) + dot(columns[2], columns[2]);
  Point linear = R(-2) * (shares.x * columns[0] + shares.y * columns[1] + shares.z * columns[2]);
  const R square = dot(shares, shares), v0 = unit * formulas::determinant(b, c, d);
  if constexpr (Crossed) {
    const Stretch<R>& k = t.stretch;
    const Point m = t.stretch.back(linear);
    const R two(2);
    return StretchedForm<R>{v0,
                            less * n.x,
                            less * n.y,
                            less * n.z,
                            squares,
                            m.x,
                            m.y,
                            m.z,
                            square * (k.k11 * k.k11),
                            square * (k.k12 * k.k12 + k.k22 * k.k22),
                            square * (k.k13 * k.k13 + k.k23 * k.k23 + k.k33 * k.k33),
                            two * square * (k.k11 * k.k12),
                            two * square * (k.k11 * k.k13),
                            two * square * (k.k12 * k.k13 + k.k22 * k.k23)};
  } else {
    return MeanRatioForm<R>{v0, less * n.x, less * n.y, less * n.z, squares, linear.x, linear.y, linear.z, square};
  }
}

/// Rank of the tetrahedron with the vertex at the origin of its places.
template <bool Crossed, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R target_rank(const TargetTetrahedron<R>& t) {
  using Point = Vec3Of<R>;
  Point columns[3] = {t.column([](const Point& row) { return row.x; }), t.column([](const Point& row) { return row.y; }),
                      t.column([](const Point& row) { return row.z; })};
  if constexpr (Crossed)
    for (Point& column : columns) column = t.stretch(column);
  const R squares = dot(columns[0], columns[0]) + dot(columns[1], columns[1]) + dot(columns[2], columns[2]);
  return formulas::square_over_cube(unit_of_rank<R>() * formulas::determinant(t.at[0], t.at[1], t.at[2]), squares);
}

}  // namespace dmoscope::volumes
