#pragma once
// Rules that decide whether the result of the fast search in float is used for a star or must be judged exactly: the same for the
// processor's lanes and a GPU's.

#include "core/base/host_device.h"
#include "core/quality/formulas.h"
#include "core/search/star.h"

namespace dmoscope::visit_rules {

/// Rank below which a star, the inverted ones' included, is the reference's; formulas::rank_doubt relies on it.
inline constexpr float kLeastRank = 1e-4F;
/// Width plus height of the star's bounding box that floats can hold, in units of SearchFrame::scale; see SearchFrame::largest_extent, too.
inline constexpr float kSmallestExtent = 0x1p-20F;
/// Smallest corner Jacobian of a star whose metric is blind, over the square of its extent: at first, and after a move.
inline constexpr float kLeastCorner = 1e-5F;
inline constexpr double kSoundCorner = 1e-9;

/// Tells metrics that are blind: their positive quality does not mean that no corner has turned over.
template <Metric M, class V>
inline constexpr bool kBlind = formulas::kDefinedForQuadrilaterals<M, V> && !formulas::Formula<M>::kSeesInversion;

/// Least Jacobian of all corners of the quadrilaterals, with the vertex at `p`.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R smallest_corner(const StarView<R>& star, Vec2<R> p) {
  using scalar::min;
  R least = scalar::constant<R>(1e30);
  for (const StarQuadrilateral<R>& q : star.quadrilaterals())
    least = min(least, formulas::smallest_jacobian(formulas::Quadrilateral<Vec2<R>>(p, q.b, q.c, q.d)));
  return least;
}

/// Verdict: stay; move; or move if the statistics' own formulas say that it gains.
enum class Verdict { Stay, Move, MoveIfExact };

/// Judges a step. `before`, `after`: the star's rank in double here and at the position that would be stored, `step` away. `sound`: no
/// corner of a blind metric is near to turning over.
template <Metric M>
[[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE Verdict judge(double before, double after, Vec2<double> step, bool sound) {
  const double doubt = formulas::rank_doubt<M>(before);
  if (!(after > before - doubt) || (step.x == 0.0 && step.y == 0.0)) return Verdict::Stay;
  return after > before + doubt && sound ? Verdict::Move : Verdict::MoveIfExact;
}

}  // namespace dmoscope::visit_rules
