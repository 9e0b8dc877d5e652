#include "core/inspect/require_star.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

void require_vertex(const InputMesh& input, Index vertex, Shape shape) {
  if (input.geometry.shape != shape)
    throw UsageError(fmt::format("only vertices of {} meshes are searched here", shape == Shape::Volume ? "volume" : "planar"));
  if (vertex >= input.mesh.vertex_count())
    throw UsageError(fmt::format("vertex {} does not exist: the mesh has {} vertices", vertex, input.mesh.vertex_count()));
}

bool defined_around(const InputMesh& input, Metric metric, Index vertex) {
  return std::ranges::all_of(input.topology.star(vertex),
                             [&](const Incidence& at) { return info(metric).defined_for(input.mesh.elements.kind(at.element)); });
}

}  // namespace dmoscope
