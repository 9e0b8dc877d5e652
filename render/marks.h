#pragma once
// Marks over the picture of a mesh.

#include <optional>
#include <vector>

#include "core/base/vec.h"
#include "render/image.h"

namespace dmoscope::render {

enum class DotShape { Round, Square, Ring, Cross, Diamond };

/// A dot at a point of the scene, see SceneView (a candidate of the grid).
struct OverlayDot {
  Vec3 point;
  float diameter = 6.0F;  // pixels at scale 1
  Rgba colour{255, 255, 255, 255};
  DotShape shape = DotShape::Round;
  friend bool operator==(const OverlayDot&, const OverlayDot&) = default;
};
/// A straight line between two points of the scene (the box of a candidate grid, a vertex's path).
struct OverlayLine {
  Vec3 from, to;
  float width = 1.5F;  // pixels at scale 1
  Rgba colour{255, 255, 255, 255};
  friend bool operator==(const OverlayLine&, const OverlayLine&) = default;
};

/// Marks on top of the elements, in this order; nothing hides them.
struct Marks {
  std::vector<Index> elements{};  // marked by all their edges
  std::vector<Index> vertices{};  // marked by dots
  std::optional<Index> worst{};   // element with a ring around it
  bool worst_behind = false;      // other elements hide it: the ring is faint
  std::vector<OverlayLine> lines{};
  std::vector<OverlayDot> dots{};      // the nearest on top
  bool triad = true;                   // the axes of a mesh in space, in the right lower corner
  bool faint_where_taken_away = true;  // faint marks for elements and vertices that are taken away entirely
  friend bool operator==(const Marks&, const Marks&) = default;
};

}  // namespace dmoscope::render
