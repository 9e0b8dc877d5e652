#pragma once
// A mesh as plain pointers, for code that runs on any processor.

#include <span>

#include "core/base/host_device.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// Pointers to a mesh's arrays, in the memory of host or device; their owner must outlive it. Frame: Plane of a planar mesh, Space of a
/// volume mesh.
template <class FrameT>
struct MeshView {
  using Frame = FrameT;
  const std::uint32_t* star_offsets = nullptr;  // see Topology
  const Incidence* incidences = nullptr;
  const Index* corner_offsets = nullptr;  // see ElementTable
  const Index* corners = nullptr;
  const double* reference_measure = nullptr;  // see InputMesh
  Frame frame;

  /// The frame that an element is judged in.
  [[nodiscard]] DMOSCOPE_ANYWHERE decltype(auto) frame_of([[maybe_unused]] Index element) const {
    if constexpr (requires { frame.of(element); })
      return frame.of(element);
    else
      return (frame);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE std::span<const Incidence> star(Index vertex) const {
    return {incidences + star_offsets[vertex], incidences + star_offsets[vertex + 1]};
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE std::span<const Index> corners_of(Index element) const {
    return {corners + corner_offsets[element], corners + corner_offsets[element + 1]};
  }
};
using PlanarView = MeshView<Plane>;
using VolumeView = MeshView<Space>;

}  // namespace dmoscope
