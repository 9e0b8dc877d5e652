#pragma once
// Star whose elements have targets, for the fast search by the mean ratio: its forms, and the quality of a place. The same code for packs
// of stars and for one.

#include <cstddef>

#include "core/base/host_device.h"
#include "core/search/star.h"
#include "core/search/target_form.h"
#include "core/smooth/kernels/star_table.h"
#include "core/smooth/kernels/visit_rules.h"

namespace dmoscope::target_star {

/// Limits for the targets of a star in lanes, and for its forms.
inline constexpr std::size_t kMaxTargets = kMaxTriangles + kQuadrilateralTargets * kMaxQuadrilaterals;
inline constexpr std::size_t kMaxForms = kMaxTriangles + kQuadrilateralTargetForms * kMaxQuadrilaterals;
static_assert(kMaxForms >= kMaxFan && kMaxTargets >= kMaxFan);

/// Limit for K's mixing of y into x: floats lose the square of that.
inline constexpr float kMostOblique = 1e3F;

/// Appends a star's forms to `forms`; `cap`: what no place can exceed, for a corner that does not change. Returns the slots for which the
/// fast search may be used: no corner is inverted or nearly so, and floats hold its forms. `at(i)`: CornerTarget i, as StarTargets has
/// them.
template <bool Crossed, class R, class At>
[[nodiscard]] DMOSCOPE_ANYWHERE auto take_forms(const StarView<R>& star, At at, TargetForm<R, Crossed>* forms, std::size_t& count, R& cap) {
  using scalar::abs, scalar::min;
  count = 0;
  cap = scalar::constant<R>(1e30);
  std::size_t next = 0;
  for (const StarTriangle<R>& t : star.triangles()) forms[count++] = target_form_of_triangle<Crossed>(t, at(next++));
  auto ready = cap > R(0);
  for (const StarQuadrilateral<R>& q : star.quadrilaterals()) {
    const CornerTarget<R> targets[kQuadrilateralTargets] = {at(next), at(next + 1), at(next + 2), at(next + 3)};
    next += kQuadrilateralTargets;
    target_forms_of_quadrilateral<Crossed>(q, targets, forms + count);
    count += kQuadrilateralTargetForms;
    const R opposite = target_form::ratio<Crossed>(q.d - q.c, q.b - q.c, targets[3]);
    cap = min(cap, target_form::quality(opposite, targets[3]));
    ready = ready & (opposite > R(visit_rules::kLeastRank));
  }
  for (std::size_t i = 0; i < count; ++i) {  // n0 has the steepness as a factor
    const R steepness = forms[i].shift + R(1);
    ready = ready & (forms[i].n0 > R(visit_rules::kLeastRank) * steepness * forms[i].s0);
  }
  if constexpr (Crossed)
    for (std::size_t i = 0; i < next; ++i) ready = ready & (abs(at(i).k12) < R(kMostOblique) * at(i).k22);
  return ready;
}

/// Quality of corners below which they are not told from inverted ones.
inline constexpr double kSoundRatio = 1e-9;

/// Metric of a star with its vertex at p; far below all others where a corner is inverted there.
template <bool Crossed, class R, class At>
[[nodiscard]] DMOSCOPE_ANYWHERE R quality(const StarView<R>& star, Vec2<R> p, At at) {
  using scalar::min, scalar::select;
  R least = scalar::constant<R>(1e30);
  std::size_t next = 0;
  const auto take = [&](Vec2<R> a, Vec2<R> b) {
    const CornerTarget<R> target = at(next++);
    const R ratio = target_form::ratio<Crossed>(a, b, target);
    least = min(least, select(ratio > scalar::constant<R>(kSoundRatio), target_form::quality(ratio, target), scalar::constant<R>(-1e30)));
  };
  for (const StarTriangle<R>& t : star.triangles()) take(t.b - p, t.c - p);
  for (const StarQuadrilateral<R>& q : star.quadrilaterals()) {
    take(q.b - p, q.d - p);
    take(q.c - q.b, p - q.b);
    take(p - q.d, q.c - q.d);
    take(q.d - q.c, q.b - q.c);
  }
  return least;
}

/// Most that rounding may change the metric of a corner, that of the statistics' formulas included: with the steepness, and with how much
/// the target stretches, which the squares of its numbers tell, for its determinant is 1.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R doubt(const CornerTarget<R>& t) {
  using scalar::max;
  const R right = t.l11 * t.l11 + t.l21 * t.l21 + t.l22 * t.l22, left = t.k11 * t.k11 + t.k12 * t.k12 + t.k22 * t.k22;
  return scalar::constant<R>(1e-10) * t.steepness * max(R(1), scalar::constant<R>(1e-4) * right * left);
}

/// Judges a move. `room`: the largest doubt() of the star's targets.
[[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE inline visit_rules::Verdict judge(double before, double after, double room,
                                                                                         Vec2<double> step) {
  using visit_rules::Verdict;
  if (!(after > before - room) || (step.x == 0.0 && step.y == 0.0)) return Verdict::Stay;
  return after > before + room ? Verdict::Move : Verdict::MoveIfExact;
}

}  // namespace dmoscope::target_star
