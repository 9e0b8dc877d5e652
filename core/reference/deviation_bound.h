#pragma once
// How far from the input whatever slides may bring the edges of curves and the faces of surfaces: the rule of single visits and of joint
// moves alike.

#include <optional>

#include "core/mesh/position_view.h"
#include "core/reference/overlay.h"

namespace dmoscope {

/// Of 60 degrees: how far a face may lean away from the facets beneath it.
inline constexpr double kLeastCosine = 0.5;
/// Facets that lean more than that away from the tangent plane end the way of a candidate.
inline constexpr double kSteepest = 0.1;

/// No edge of a curve and no face of a surface deviates from the input by more than the bound, or leans more than 60 degrees away from it,
/// unless it did before. The domain must outlive it.
class DeviationBound {
 public:
  /// `most`: in mesh units.
  DeviationBound(const Domain& domain, double most) : domain_(domain), most_(most) {}

  [[nodiscard]] double most() const noexcept { return most_; }
  /// May edges of a curve deviate as far, if they did by `before`?
  [[nodiscard]] bool allows(double deviation, double before) const noexcept { return deviation <= most_ || deviation <= before; }
  /// The greater deviation of a vertex's two edges along its curve, with it somewhere between its neighbours.
  [[nodiscard]] double along_curve(PositionView positions, Index vertex, const Curves::Neighbours& beside, double place,
                                   Vec3 position) const;

  /// A vertex that would move, and what is beneath it there, if it is on a surface.
  struct Move {
    Index vertex;
    Vec3 from, to;
    const FacetPlace *beneath_from = nullptr, *beneath_to = nullptr;
  };
  /// Do the faces around keep near the input with the vertex where it goes? `now`: of these before, once it is known.
  [[nodiscard]] bool allows_faces(PositionView positions, const Move& move, OverlayRoom& room, std::optional<Fit>& now) const;

 private:
  const Domain& domain_;
  double most_;
};

}  // namespace dmoscope
