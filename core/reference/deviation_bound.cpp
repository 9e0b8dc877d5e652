#include "core/reference/deviation_bound.h"

namespace dmoscope {

double DeviationBound::along_curve(PositionView positions, Index vertex, const Curves::Neighbours& beside, double place,
                                   Vec3 position) const {
  const Curves& curves = domain_.curves();
  return std::max(curves.deviation(vertex, beside.place_before, place, positions[beside.before], position),
                  curves.deviation(vertex, place, beside.place_after, position, positions[beside.after]));
}

bool DeviationBound::allows_faces(PositionView positions, const Move& move, OverlayRoom& room, std::optional<Fit>& now) const {
  if (!domain_.faces().any()) return true;
  Overlay overlay(domain_, room);
  const Fit bound{most_, most_, kLeastCosine};
  if (is_within(overlay.star(positions, move.vertex, move.to, move.beneath_to, bound), bound)) return true;
  // Allows also a fit that is no worse than the present one.
  if (!now) now = overlay.star(positions, move.vertex, move.from, move.beneath_from, kNoFit);
  if (now->deviation == kNoFit.deviation && !domain_.faces().are_own())
    return overlay.keeps_what_lies(positions, move.vertex, move.from, move.beneath_from, move.to, move.beneath_to, bound);
  if (now->deviation == kNoFit.deviation || is_within(*now, bound)) return false;
  const Fit worst = worse(bound, *now);
  return is_within(overlay.star(positions, move.vertex, move.to, move.beneath_to, worst), worst);
}

}  // namespace dmoscope
