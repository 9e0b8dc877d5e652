#pragma once
// The mean ratio of corners that have a target, in the plane: a fraction N(p) / S(p) of the place p of a star's vertex, like RatioForm.
//
// A corner whose edges are the columns of A has the mean ratio 2 det J / |J|^2, J = K A W^-1 (FormulaSpace). Turning J or W^-1 changes
// nothing, so W^-1 may be lower triangular and K upper triangular; scaling changes nothing either, so their determinants are 1.

#include "core/base/host_device.h"
#include "core/quality/formulas.h"
#include "core/search/ratio_form.h"

namespace dmoscope {

/// Target of one corner.
template <class R>
struct CornerTarget {
  R l11, l21, l22;  // lower triangle of W^-1
  R steepness;      // see ElementTarget
  R k11, k12, k22;  // upper triangle of K
};

/// Number of scalars that a CornerTarget occupies in memory: K is left out if no form is crossed.
[[nodiscard]] DMOSCOPE_ANYWHERE std::size_t target_numbers(bool crossed) { return crossed ? 7 : 4; }

/// Reads a CornerTarget from memory. number(k): its k-th scalar.
template <bool Crossed, class R, class Number>
[[nodiscard]] DMOSCOPE_ANYWHERE CornerTarget<R> corner_target(Number number) {
  CornerTarget<R> t{number(0), number(1), number(2), number(3), R(1), R(0), R(1)};
  if constexpr (Crossed) {
    t.k11 = number(4);
    t.k12 = number(5);
    t.k22 = number(6);
  }
  return t;
}

/// Mean ratio of a corner below which the search stops, however little the corner's metric counts beside that of a steep one.
inline constexpr double kLeastTargetRatio = 1e-6;

/// Form of a corner with a target. Crossed: K differs along x and y, so that S has three terms of second order.
template <class R, bool Crossed>
struct TargetForm;

template <class R>
struct TargetForm<R, false> : RatioForm<R> {
  static constexpr bool kShifted = true;
  R shift;  // the metric is N / S less this

  [[nodiscard]] DMOSCOPE_ANYWHERE R quality(R ratio) const { return ratio - shift; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R threshold(R t) const {
    using scalar::max;
    return max(t + shift, scalar::constant<R>(kLeastTargetRatio));
  }
};

template <class R>
struct TargetForm<R, true> {
  static constexpr bool kCrossed = true, kShifted = true;
  R n0, nx, ny;
  R s0, sx, sy, sxx, sxy, syy;
  R shift;

  [[nodiscard]] DMOSCOPE_ANYWHERE R second_order(Vec2<R> p, R /*squared*/) const {
    return sxx * (p.x * p.x) + sxy * (p.x * p.y) + syy * (p.y * p.y);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE R along_x() const { return sxx; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R along_y() const { return syy; }
  DMOSCOPE_ANYWHERE void move_slopes(Vec2<R> centre) {
    sx = sx + R(2) * sxx * centre.x + sxy * centre.y;
    sy = sy + R(2) * syy * centre.y + sxy * centre.x;
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE R quality(R ratio) const { return ratio - shift; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R threshold(R t) const {
    using scalar::max;
    return max(t + shift, scalar::constant<R>(kLeastTargetRatio));
  }
};

namespace target_form {

/// Columns of J of a corner whose edges are a, towards the next corner, and b, towards the previous one.
template <bool Crossed, class R>
struct Columns {
  Vec2<R> first, second;
  DMOSCOPE_ANYWHERE Columns(Vec2<R> a, Vec2<R> b, const CornerTarget<R>& t)
      : first(stretched({t.l11 * a.x + t.l21 * b.x, t.l11 * a.y + t.l21 * b.y}, t)), second(stretched({t.l22 * b.x, t.l22 * b.y}, t)) {}

  [[nodiscard]] static DMOSCOPE_ANYWHERE Vec2<R> stretched(Vec2<R> v, [[maybe_unused]] const CornerTarget<R>& t) {
    if constexpr (Crossed)
      return {t.k11 * v.x + t.k12 * v.y, t.k22 * v.y};
    else
      return v;
  }
};

/// The mean ratio of a corner, from its edges a and b.
template <bool Crossed, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R ratio(Vec2<R> a, Vec2<R> b, const CornerTarget<R>& t) {
  using scalar::select;
  const Columns<Crossed, R> j(a, b, t);
  const R squares = dot(j.first, j.first) + dot(j.second, j.second);
  return R(2) * cross(a, b) / select(squares > R(0), squares, R(1));
}
/// The metric of a corner with this mean ratio.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R quality(R ratio, const CornerTarget<R>& t) {
  return R(1) - (R(1) - ratio) * t.steepness;
}

/// The form of a corner whose edges are a and b while the vertex is at the origin. `with_a`, `with_b`: the factor by which each edge
/// follows the vertex: 1 if it leads to the vertex, -1 if it comes from it, else 0. Twice the area of from, to and the vertex is the
/// corner's determinant.
template <bool Crossed, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE TargetForm<R, Crossed> form(Vec2<R> a, Vec2<R> b, R with_a, R with_b, Vec2<R> from, Vec2<R> to,
                                                            const CornerTarget<R>& t) {
  const Columns<Crossed, R> j(a, b, t);
  const R first = t.l11 * with_a + t.l21 * with_b, second = t.l22 * with_b;  // factors of the vertex's place
  const R squares = first * first + second * second;
  RatioForm<R> area;
  ratio_form::set_area(area, from, to, R(2) * t.steepness);
  const R x = first * j.first.x + second * j.second.x, y = first * j.first.y + second * j.second.y;
  TargetForm<R, Crossed> f;
  f.n0 = area.n0;
  f.nx = area.nx;
  f.ny = area.ny;
  f.s0 = dot(j.first, j.first) + dot(j.second, j.second);
  f.shift = t.steepness - R(1);
  if constexpr (Crossed) {
    f.sx = R(2) * (t.k11 * x);
    f.sy = R(2) * (t.k12 * x + t.k22 * y);
    f.sxx = squares * (t.k11 * t.k11);
    f.sxy = R(2) * squares * (t.k11 * t.k12);
    f.syy = squares * (t.k12 * t.k12 + t.k22 * t.k22);
  } else {
    f.sx = R(2) * x;
    f.sy = R(2) * y;
    f.s2 = squares;
  }
  return f;
}

}  // namespace target_form

/// The form of a triangle with the vertex and b, c.
template <bool Crossed, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE TargetForm<R, Crossed> target_form_of_triangle(const StarTriangle<R>& e, const CornerTarget<R>& target) {
  return target_form::form<Crossed>(e.b, e.c, R(-1), R(-1), e.b, e.c, target);
}

/// Number of a quadrilateral's corners that have targets, and number of those that change with the vertex.
inline constexpr std::size_t kQuadrilateralTargets = 4, kQuadrilateralTargetForms = 3;

/// The forms of a quadrilateral with the vertex and b, c, d: of the corners at the vertex, at b and at d. `targets`: those of these three
/// corners and of the corner at c.
template <bool Crossed, class R>
DMOSCOPE_ANYWHERE void target_forms_of_quadrilateral(const StarQuadrilateral<R>& q, const CornerTarget<R>* targets,
                                                     TargetForm<R, Crossed>* forms) {
  using target_form::form;
  forms[0] = form<Crossed>(q.b, q.d, R(-1), R(-1), q.b, q.d, targets[0]);
  const Vec2<R> origin{R(0), R(0)};
  forms[1] = form<Crossed>(q.c - q.b, origin - q.b, R(0), R(1), q.b, q.c, targets[1]);
  forms[2] = form<Crossed>(origin - q.d, q.c - q.d, R(1), R(0), q.c, q.d, targets[2]);
}

}  // namespace dmoscope
