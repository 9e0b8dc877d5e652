#pragma once
// A few elements or vertices of a frame, whose positions may be on the host, or on a device from which only these are downloaded.

#include <span>
#include <vector>

#include "core/view/view.h"

namespace dmoscope {

/// Positions of some vertices, in their order. Throws DeviceError.
[[nodiscard]] std::vector<Vec3> positions_of(const Frame& frame, std::span<const Index> vertices);

/// Some elements of a frame as a mesh of their own.
struct Patch {
  Mesh mesh;                      // mesh whose element k is the frame's elements[k]
  std::vector<Index> vertices;    // the frame's vertices, ascending: vertex i of the mesh is vertices[i]
  const Geometry& geometry;       // geometry of the frame's input, which must outlive the patch
  std::vector<Index> elements{};  // elements of the frame
  std::shared_ptr<const InputMesh> input{};
  /// Quality of element k, with the same bits as in the whole mesh.
  [[nodiscard]] double quality(Metric metric, Index k) const;
  [[nodiscard]] bool inverted(Index k) const { return smallest_jacobian({mesh, geometry}, mesh.positions, k) <= 0.0; }
  /// Point inside element k where it is inverted, see dmoscope::inverted_inside().
  [[nodiscard]] std::optional<Vec3> inverted_inside(Index k) const {
    return dmoscope::inverted_inside({mesh, geometry}, mesh.positions, k);
  }
};

/// Makes a patch of some elements, in one download. Throws DeviceError.
[[nodiscard]] Patch patch_of(const Frame& frame, std::span<const Index> elements);

}  // namespace dmoscope
