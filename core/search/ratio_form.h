#pragma once
// Metrics of ratio form: at a candidate p of a star's vertex each element's metric is the least of a few fractions N(p) / S(p) with N
// affine in p and S(p) = s0 + sx x + sy y + s2 |p|^2 > 0.

#include "core/base/host_device.h"
#include "core/quality/formulas.h"
#include "core/search/star.h"

namespace dmoscope {

template <class R>
struct RatioForm {
  static constexpr bool kCrossed = false, kShifted = false;  // see TargetForm
  R n0, nx, ny;
  R s0, sx, sy, s2;  // coefficients of S; all 0 for a condition: N must be positive and does not count otherwise

  /// Second-order part of S; `squared`: |p|^2.
  [[nodiscard]] DMOSCOPE_ANYWHERE R second_order(Vec2<R> /*p*/, R squared) const { return s2 * squared; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R along_x() const { return s2; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R along_y() const { return s2; }
  /// Makes `centre` the origin of sx and sy.
  DMOSCOPE_ANYWHERE void move_slopes(Vec2<R> centre) {
    sx = sx + R(2) * s2 * centre.x;
    sy = sy + R(2) * s2 * centre.y;
  }
  /// The metric at N / S = `ratio`; the other function is the ratio that N / S must exceed for a metric above t.
  [[nodiscard]] DMOSCOPE_ANYWHERE R quality(R ratio) const { return ratio; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R threshold(R t) const { return t; }
};

/// Whether the fast search can use threshold rounds for this metric.
template <Metric M>
inline constexpr bool kIsRatio = M == Metric::MeanRatio || M == Metric::MeanRatioArea;

/// Number of forms of a quadrilateral.
template <Metric M>
inline constexpr int kQuadrilateralForms = M == Metric::MeanRatio ? 3 : 4;

namespace ratio_form {

/// Sets N to twice the area of the triangle p, b, c, times `factor`: b x c + p x (b - c).
template <class R>
DMOSCOPE_ANYWHERE void set_area(RatioForm<R>& form, Vec2<R> b, Vec2<R> c, R factor) {
  form.n0 = factor * cross(b, c);
  form.nx = factor * (b.y - c.y);
  form.ny = factor * (c.x - b.x);
}

/// Sets S to |p - b|^2 + |p - c|^2 + rest.
template <class R>
DMOSCOPE_ANYWHERE void set_two_edges(RatioForm<R>& form, Vec2<R> b, Vec2<R> c, R rest) {
  form.s0 = dot(b, b) + dot(c, c) + rest;
  form.sx = R(-2) * (b.x + c.x);
  form.sy = R(-2) * (b.y + c.y);
  form.s2 = R(2);
}

/// Sets S to |p - b|^2 + rest.
template <class R>
DMOSCOPE_ANYWHERE void set_one_edge(RatioForm<R>& form, Vec2<R> b, R rest) {
  form.s0 = dot(b, b) + rest;
  form.sx = R(-2) * b.x;
  form.sy = R(-2) * b.y;
  form.s2 = R(1);
}

}  // namespace ratio_form

/// The form of a triangle with the vertex and b, c.
template <class R>
DMOSCOPE_ANYWHERE void triangle_form(const StarTriangle<R>& t, RatioForm<R>& form) {
  const Vec2<R> e = t.c - t.b;
  ratio_form::set_area(form, t.b, t.c, scalar::constant<R>(2.0 * formulas::sqrt3));
  ratio_form::set_two_edges(form, t.b, t.c, dot(e, e));
}

/// The forms of a quadrilateral with the vertex and b, c, d. Returns an upper bound for all candidates: the metric of the corner opposite
/// to the vertex, if that corner is judged by itself.
template <Metric M, class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R quadrilateral_forms(const StarQuadrilateral<R>& q, RatioForm<R>* forms) {
  using namespace ratio_form;
  const Vec2<R> bc = q.c - q.b, cd = q.d - q.c;
  const R bc2 = dot(bc, bc), cd2 = dot(cd, cd), factor(2);
  if constexpr (M == Metric::MeanRatio) {  // per corner: 2 J / (sum of the squares of its two edges)
    set_area(forms[0], q.b, q.d, factor);
    set_two_edges(forms[0], q.b, q.d, R(0));
    set_area(forms[1], q.b, q.c, factor);
    set_one_edge(forms[1], q.b, bc2);
    set_area(forms[2], q.c, q.d, factor);
    set_one_edge(forms[2], q.d, cd2);
    return factor * cross(bc, cd) / (bc2 + cd2);
  } else {  // 2 (J_b + J_d) / (sum of the squares of all edges), and a positive Jacobian at every corner of the vertex's elements
    set_area(forms[1], q.b, q.c, factor);
    set_area(forms[2], q.c, q.d, factor);
    set_area(forms[3], q.b, q.d, factor);
    forms[0].n0 = forms[1].n0 + forms[2].n0;
    forms[0].nx = forms[1].nx + forms[2].nx;
    forms[0].ny = forms[1].ny + forms[2].ny;
    set_two_edges(forms[0], q.b, q.d, bc2 + cd2);
    // Scales the condition, so that it is not the least form as long as it holds.
    const R scale = scalar::constant<R>(1e6) / forms[0].s0;
    for (int i = 1; i < 4; ++i) forms[i] = {scale * forms[i].n0, scale * forms[i].nx, scale * forms[i].ny, R(0), R(0), R(0), R(0)};
    return scalar::constant<R>(1e30);
  }
}

}  // namespace dmoscope
