#include "core/search/surface_star.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmoscope {

void gather_star(const MeshView<Curved>& mesh, PositionView positions, Index vertex, SurfaceStar& out) {
  out.triangles.clear();
  out.quadrilaterals.clear();
  const Vec3 origin = positions[vertex];
  double extent = 0.0;
  for (const Incidence& at : mesh.star(vertex)) {
    for (const Index other : mesh.corners_of(at.element)) {
      const Vec3 way = positions[other] - origin;
      extent = std::max({extent, std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    }
  }
  out.scale = extent > 0.0 && std::isfinite(extent) ? extent : 1.0;
  const double inverse = 1.0 / out.scale;
  for (const Incidence& at : mesh.star(vertex)) {
    const auto corners = mesh.corners_of(at.element);
    const auto after = [&](std::size_t i) { return inverse * (positions[corners[(at.corner + i) % corners.size()]] - origin); };
    const double reference = mesh.reference_measure[at.element] * inverse * inverse;
    if (corners.size() == 3)
      out.triangles.push_back({after(1), after(2), reference, mesh.frame.normal});
    else
      out.quadrilaterals.push_back({after(1), after(2), after(3), reference, mesh.frame.normal, mesh.frame.mostly_flat});
  }
}

}  // namespace dmoscope
