#include "core/view/patch.h"

#include <algorithm>
#include <limits>

#include "core/quality/defined_quality.h"

namespace dmoscope {

std::vector<Vec3> positions_of(const Frame& frame, std::span<const Index> vertices) {
  if (frame.device) return frame.device->positions(vertices);
  std::vector<Vec3> positions;
  positions.reserve(vertices.size());
  for (const Index vertex : vertices) positions.push_back(frame.positions[vertex]);
  return positions;
}

Patch patch_of(const Frame& frame, std::span<const Index> elements) {
  const ElementTable& all = frame.input->mesh.elements;
  Patch patch{{}, {}, frame.input->geometry, {elements.begin(), elements.end()}, frame.input};
  for (const Index element : elements) {
    const auto corners = all.corners(element);
    patch.vertices.insert(patch.vertices.end(), corners.begin(), corners.end());
  }
  std::ranges::sort(patch.vertices);
  // Avoids std::ranges::unique, which clang 14 does not compile with this standard library.
  patch.vertices.erase(std::unique(patch.vertices.begin(), patch.vertices.end()), patch.vertices.end());
  std::vector<Index> renamed;
  for (const Index element : elements) {
    renamed.clear();
    for (const Index corner : all.corners(element))
      renamed.push_back(static_cast<Index>(std::ranges::lower_bound(patch.vertices, corner) - patch.vertices.begin()));
    patch.mesh.elements.add(all.kind(element), renamed);
  }
  patch.mesh.positions = positions_of(frame, patch.vertices);
  return patch;
}

double Patch::quality(Metric metric, Index k) const {
  if (is_built_in(metric)) return element_quality({mesh, geometry}, mesh.positions, metric, k);
  const auto judge = input->quality_context().find_judge(metric);
  if (!judge) return std::numeric_limits<double>::quiet_NaN();
  return defined_quality_at(*judge, {geometry, input->surface_normals}, mesh.elements.kind(k), mesh.elements.corners(k), elements[k],
                            [this](Index v) { return mesh.positions[v]; });
}

}  // namespace dmoscope
