#pragma once
// Formulas of one element for the fast search of volumes, for packs of candidates and for a GPU's lanes alike: the same operations in the
// same order, so that both find the same bits.

#include "core/base/host_device.h"
#include "core/quality/formulas.h"

namespace dmoscope::volumes {

/// Mean ratio of a tetrahedron or of a corner of another volume element as the vertex moves, as its rank (its cube, formulas::rank): v |v|
/// / s^3. The determinant v is affine in the vertex's place p, the squared norm s affine plus `square` |p|^2. R: float or a pack of it.
template <class R>
struct MeanRatioForm {
  R v0, vx, vy, vz;
  R s0, sx, sy, sz, square;
};

/// Form of the tetrahedron of the vertex and b, c, d.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE MeanRatioForm<R> tetrahedron_form(Vec3Of<R> b, Vec3Of<R> c, Vec3Of<R> d) {
  // Uses det(b - p, c - p, d - p) = det(b, c, d) - p . ((b x c) + (c x d) + (d x b)).
  using Point = Vec3Of<R>;
  const Point n = cross(b, c) + cross(c, d) + cross(d, b), sum = b + c + d;
  const Point bc = c - b, cd = d - c, db = b - d;
  const R squares = dot(b, b) + dot(c, c) + dot(d, d) + dot(bc, bc) + dot(cd, cd) + dot(db, db);
  const R unit = scalar::constant<R>(20.784609690826528);  // sqrt(432)
  const R less = R(0) - unit, two = R(-2);
  return {unit * formulas::determinant(b, c, d), less * n.x, less * n.y, less * n.z, squares, two * sum.x, two * sum.y, two * sum.z, R(3)};
}

/// Form of a corner whose edges are u, v and w while the vertex is at the origin. `with`: the factor by which each edge follows the vertex:
/// 1 if it leads to the vertex, -1 if it comes from it, else 0.
template <class Ideal, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE MeanRatioForm<R> corner_form(Vec3Of<R> u, Vec3Of<R> v, Vec3Of<R> w, Vec3Of<R> with) {
  using Point = Vec3Of<R>;
  const R unit = scalar::constant<R>(5.196152422706632 * Ideal::kDeterminant);  // sqrt(27)
  const Point n = unit * (with.x * cross(v, w) + with.y * cross(w, u) + with.z * cross(u, v));
  // Takes the columns of the corner's Jacobian against the ideal one as those at the origin plus their shares of p.
  const std::array<Point, 3> at = Ideal::against_ideal(u, v, w);
  const std::array<Point, 3> share = Ideal::against_ideal(Point{with.x, R(0), R(0)}, Point{with.y, R(0), R(0)}, Point{with.z, R(0), R(0)});
  const Point linear = R(2) * (share[0].x * at[0] + share[1].x * at[1] + share[2].x * at[2]);
  return {unit * formulas::determinant(u, v, w), n.x, n.y, n.z, formulas::squared_norm(at), linear.x, linear.y, linear.z,
          formulas::squared_norm(share)};
}
/// Calls f with the form of each corner that changes when corner `moving`, which is at the origin, moves.
template <class Point, class Ideal, std::size_t N, class Corners, class F>
DMOSCOPE_ANYWHERE void for_corner_forms(const formulas::CorneredSolid<Point, Ideal, N, Corners>& element, Index moving, F f) {
  using R = formulas::RealOf<Point>;
  for (std::size_t i = 0; i < Corners::kTable.size(); ++i) {
    const CornerTable c = formulas::row_of<Corners>(i);
    const auto share = [&](std::size_t edge) { return c[0] == moving ? R(-1) : c[edge] == moving ? R(1) : R(0); };
    if (c[0] != moving && c[1] != moving && c[2] != moving && c[3] != moving) continue;
    const Point a = element.at[c[0]];
    f(corner_form<Ideal>(element.at[c[1]] - a, element.at[c[2]] - a, element.at[c[3]] - a, Point{share(1), share(2), share(3)}));
  }
}

/// Determinant and squared norm with the vertex at p; `square`: |p|^2.
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE F determinant_of(const MeanRatioForm<R>& f, const Vec3Of<F>& p) {
  return F(f.v0) + F(f.vx) * p.x + F(f.vy) * p.y + F(f.vz) * p.z;
}
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE F squares_of(const MeanRatioForm<R>& f, const Vec3Of<F>& p, F square) {
  return F(f.s0) + F(f.sx) * p.x + F(f.sy) * p.y + F(f.sz) * p.z + F(f.square) * square;
}
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE F rank_of(const MeanRatioForm<R>& f, const Vec3Of<F>& p, F square) {
  return formulas::square_over_cube(determinant_of(f, p), squares_of(f, p, square));
}

/// Gradient of the squared norm by p.
template <class F, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<F> slope_of_squares(const MeanRatioForm<R>& f, const Vec3Of<F>& p) {
  const F twice = F(2) * F(f.square);
  return {F(f.sx) + twice * p.x, F(f.sy) + twice * p.y, F(f.sz) + twice * p.z};
}

/// Rank below which the reference searches, since floats do not tell such elements apart.
inline constexpr float kLeastRank = 1e-6F;

}  // namespace dmoscope::volumes
