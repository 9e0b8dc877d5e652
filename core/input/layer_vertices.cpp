#include "core/input/layer_vertices.h"

#include <algorithm>

#include "core/quality/quality.h"
#include "core/target/boundary_layers.h"

namespace dmoscope {

std::vector<Index> layer_vertices(const Mesh& mesh, const Geometry& geometry) {
  if (!may_have_layers(mesh, geometry)) return {};
  const BoundaryLayers layers = find_boundary_layers(mesh, geometry);
  const QualityContext context{mesh, geometry};
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < layers.elements.size(); ++i) {
    if (layers.pronounced[i] == 0 || !(smallest_jacobian(context, mesh.positions, layers.elements[i]) > 0.0)) continue;
    const auto corners = mesh.elements.corners(layers.elements[i]);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace dmoscope
