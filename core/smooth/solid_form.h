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

/// Below this rank the search is the reference's, since floats do not tell such elements apart.
inline constexpr float kLeastRank = 1e-6F;

}  // namespace dmoscope::solids
