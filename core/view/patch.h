#pragma once
// A few elements or vertices of a frame, wherever its positions are: on the host, or on a device from which only these are brought.

#include <span>
#include <vector>

#include "core/view/view.h"

namespace dmoscope {

/// Where some vertices are, in their order. Throws DeviceError.
[[nodiscard]] std::vector<Vec3> positions_of(const Frame& frame, std::span<const Index> vertices);

/// Some elements of a frame as a mesh of their own.
struct Patch {
  Mesh mesh;                      // its element k is the frame's elements[k]
  std::vector<Index> vertices;    // of the frame: the mesh's vertex i is its vertices[i]; ascending
  const Geometry& geometry;       // of the frame's input, which must outlive the patch
  std::vector<Index> elements{};  // of the frame, see above
  std::shared_ptr<const InputMesh> input{};
  /// The same bits as those of the whole mesh.
  [[nodiscard]] double quality(Metric metric, Index k) const;
  [[nodiscard]] bool inverted(Index k) const { return smallest_jacobian({mesh, geometry}, mesh.positions, k) <= 0.0; }
  /// See dmoscope::inverted_inside().
  [[nodiscard]] std::optional<Vec3> inverted_inside(Index k) const {
    return dmoscope::inverted_inside({mesh, geometry}, mesh.positions, k);
  }
};

/// Brings all that is needed in one go. Throws DeviceError.
[[nodiscard]] Patch patch_of(const Frame& frame, std::span<const Index> elements);

}  // namespace dmoscope
