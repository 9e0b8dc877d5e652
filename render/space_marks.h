#pragma once
// What is marked over the picture of a volume mesh.

#include <array>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"
#include "render/orbit_camera.h"
#include "render/style.h"

namespace dmoscope::render {

/// A dot and a line in the space of the mesh (a candidate of the grid, its box).
struct SpaceDot {
  Vec3 point;
  float diameter = 6.0F;  // pixels at scale 1
  Rgba colour{255, 255, 255, 255};
  DotShape shape = DotShape::Round;
  friend bool operator==(const SpaceDot&, const SpaceDot&) = default;
};
struct SpaceLine {
  Vec3 from, to;
  float width = 1.5F;  // pixels at scale 1
  Rgba colour{255, 255, 255, 255};
  friend bool operator==(const SpaceLine&, const SpaceLine&) = default;
};

/// What is marked over the picture; nothing hides it.
struct SpaceMarks {
  std::vector<Index> cells;     // all their edges
  std::vector<Index> vertices;  // dots
  std::optional<Index> worst;   // cell with a ring around it
  bool worst_behind = false;    // others hide it: the ring is faint
  std::vector<SpaceLine> lines;
  std::vector<SpaceDot> dots;          // the nearest on top
  bool triad = true;                   // the axes, in the right lower corner
  bool faint_where_taken_away = true;  // marks of cells and vertices of which nothing is seen
  friend bool operator==(const SpaceMarks&, const SpaceMarks&) = default;
};

/// Where the letters of the axes are in a viewport, in pixels from its upper left corner: x, y, z.
[[nodiscard]] std::array<Vec2<double>, 3> triad_letters(const OrbitCamera& camera, Vec2<double> viewport, double scale);

}  // namespace dmoscope::render
