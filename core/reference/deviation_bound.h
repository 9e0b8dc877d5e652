#pragma once
// Bound on the deviation of edges of curves and faces of surfaces from the input, for single visits and joint moves.

#include <optional>

#include "core/mesh/position_view.h"
#include "core/reference/overlay.h"

namespace dmoscope {

/// Cosine of 60 degrees, the greatest angle by which a face may lean away from the facets beneath it.
inline constexpr double kLeastCosine = 0.5;
/// Cosine of the greatest angle between a facet and the tangent plane: steeper facets end the way of a candidate.
inline constexpr double kSteepest = 0.1;

/// Bound that no edge of a curve and no face of a surface exceeds: neither in its deviation from the input nor by leaning more than 60
/// degrees away from it, unless it did before. The domain must outlive it.
class DeviationBound {
 public:
  /// Sets the bound. `most`: in mesh units.
  DeviationBound(const Domain& domain, double most) : domain_(domain), most_(most) {}

  [[nodiscard]] double most() const noexcept { return most_; }
  /// Whether edges of a curve may have this deviation, given that `before` it was another one.
  [[nodiscard]] bool allows(double deviation, double before) const noexcept { return deviation <= most_ || deviation <= before; }
  /// The greater deviation of a vertex's two edges along its curve, with it between its neighbours.
  [[nodiscard]] double along_curve(PositionView positions, Index vertex, const Curves::Neighbours& beside, double place,
                                   Vec3 position) const;

  /// A possible move of a vertex, and the facet beneath its new place, if it is on a surface.
  struct Move {
    Index vertex;
    Vec3 from, to;
    const FacetPlace *beneath_from = nullptr, *beneath_to = nullptr;
  };
  /// Whether the faces around stay near the input with the vertex in its new place. `now`: fit of these faces before, computed if needed.
  [[nodiscard]] bool allows_faces(PositionView positions, const Move& move, OverlayRoom& room, std::optional<Fit>& now) const;

 private:
  const Domain& domain_;
  double most_;
};

}  // namespace dmoscope
