#pragma once
// What the fast search of volumes computes of one element, for packs of candidates and for a GPU's lanes alike: the same operations in the
// same order, so that both find the same bits.

#include "core/base/anywhere.h"
#include "core/quality/solids.h"

namespace dmoscope::solids {

/// The mean ratio of a tetrahedron as the vertex moves: six times the volume is affine in its place p, the sum of the squared edges affine
/// plus 3 |p|^2.
template <class F>
struct TetrahedronForm {
  F v0, vx, vy, vz;
  F s0, sx, sy, sz;
};

template <class F>
[[nodiscard]] DMOSCOPE_ANYWHERE TetrahedronForm<F> tetrahedron_form(Vec3Of<F> b, Vec3Of<F> c, Vec3Of<F> d) {
  // det(b - p, c - p, d - p) = det(b, c, d) - p . ((b x c) + (c x d) + (d x b)).
  using Point = Vec3Of<F>;
  const Point n = cross(b, c) + cross(c, d) + cross(d, b), sum = b + c + d;
  const Point bc = c - b, cd = d - c, db = b - d;
  const F squares = dot(b, b) + dot(c, c) + dot(d, d) + dot(bc, bc) + dot(cd, cd) + dot(db, db);
  const F two = F(-2);
  return {formulas::determinant(b, c, d), F(0) - n.x, F(0) - n.y, F(0) - n.z, squares, two * sum.x, two * sum.y, two * sum.z};
}
template <class F>
[[nodiscard]] DMOSCOPE_ANYWHERE F six_volume(const TetrahedronForm<F>& f, const Vec3Of<F>& p) {
  return f.v0 + f.vx * p.x + f.vy * p.y + f.vz * p.z;
}
/// Of the edges; `square`: |p|^2.
template <class F>
[[nodiscard]] DMOSCOPE_ANYWHERE F squares(const TetrahedronForm<F>& f, const Vec3Of<F>& p, F square) {
  return f.s0 + f.sx * p.x + f.sy * p.y + f.sz * p.z + F(3) * square;
}
template <class F>
[[nodiscard]] DMOSCOPE_ANYWHERE F rank_of(const TetrahedronForm<F>& f, const Vec3Of<F>& p, F square) {
  return F(432) * formulas::square_over_cube(six_volume(f, p), squares(f, p, square));
}

template <Metric M, class Ideal, class Point>
[[nodiscard]] DMOSCOPE_ANYWHERE formulas::RealOf<Point> rank_of_corner(Point u, Point v, Point w, formulas::RealOf<Point> jacobian) {
  if constexpr (M == Metric::MeanRatio)
    return formulas::SolidFormula<M>::template rank_corner<Ideal>(u, v, w, jacobian);
  else
    return formulas::SolidFormula<M>::template corner<Ideal>(u, v, w, jacobian);
}
/// The rank of the corners that change with the vertex.
template <Metric M, class Point, class Ideal, std::size_t N, class Corners>
[[nodiscard]] DMOSCOPE_ANYWHERE auto moving_part(const formulas::CorneredSolid<Point, Ideal, N, Corners>& solid, Index moving) {
  using F = formulas::RealOf<Point>;
  return solid.least_around(moving, [](Point u, Point v, Point w, F jacobian) { return rank_of_corner<M, Ideal>(u, v, w, jacobian); });
}
/// And of all the others.
template <Metric M, class Point, class Ideal, std::size_t N, class Corners>
[[nodiscard]] DMOSCOPE_ANYWHERE auto constant_part(const formulas::CorneredSolid<Point, Ideal, N, Corners>& solid, Index moving) {
  using scalar::min;
  using F = formulas::RealOf<Point>;
  F least(1e30F);
  for (std::size_t i = 0; i < Corners::kTable.size(); ++i) {
    const formulas::CornerTable c = formulas::row_of<Corners>(i);
    if (c[0] == moving || c[1] == moving || c[2] == moving || c[3] == moving) continue;
    const Point u = solid.at[c[1]] - solid.at[c[0]], v = solid.at[c[2]] - solid.at[c[0]], w = solid.at[c[3]] - solid.at[c[0]];
    least = min(least, rank_of_corner<M, Ideal>(u, v, w, formulas::determinant(u, v, w)));
  }
  return least;
}

/// Below this rank the search is the reference's, since floats do not tell such elements apart.
inline constexpr float kLeastRank = 1e-6F;

}  // namespace dmoscope::solids
