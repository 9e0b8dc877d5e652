#pragma once
// Maps a mesh's positions to its scene, in a plane or in space.

#include <optional>

#include "core/input/input_mesh.h"
#include "core/mesh/plane.h"
#include "render/scene_view.h"

namespace dmoscope::ui {

/// Maps positions of a mesh to points of its scene.
struct ScenePoints {
  std::optional<Plane> plane{};  // plane of a planar mesh; none: the points are the positions

  [[nodiscard]] static ScenePoints of(const InputMesh& input) {
    return {input.in_space() ? std::nullopt : std::optional(input.geometry.plane)};
  }
  [[nodiscard]] Vec3 at(Vec3 position) const { return plane ? render::in_scene(plane->place(position)) : position; }
  /// The point of a position that belongs to one at `other`: on a mesh that wraps they stand together.
  [[nodiscard]] Vec3 at(Vec3 position, Vec3 other) const {
    return plane && plane->period > 0.0 ? at(other) + way(position, other) : at(position);
  }
  [[nodiscard]] Vec3 way(Vec3 to, Vec3 from) const { return plane ? render::in_scene(plane->offset(to, from)) : to - from; }
  /// Direction in the scene of a vector of the mesh's space.
  [[nodiscard]] Vec3 along(Vec3 vector) const { return plane ? render::in_scene(plane->project(vector)) : vector; }
};

}  // namespace dmoscope::ui
