#include "core/search/surface_star.h"

#include <cmath>

namespace dmoscope {

void gather_star(const MeshView<Curved>& mesh, PositionView positions, Index vertex, SurfaceStar& out) {
  out.triangles.clear();
  out.quadrilaterals.clear();
  const Vec3 origin = positions[vertex];
  double extent = 0.0;
  const auto reach = [&extent](Vec3 way) {
    for (const double size : {std::abs(way.x), std::abs(way.y), std::abs(way.z)}) extent = size > extent ? size : extent;
  };
  for (const Incidence& at : mesh.star(vertex)) {
    const auto corners = mesh.corners_of(at.element);
    const auto after = [&](std::size_t i) {
      const std::size_t c = at.corner + i;
      const Vec3 way = positions[corners[c < corners.size() ? c : c - corners.size()]] - origin;
      reach(way);
      return way;
    };
    const double reference = mesh.reference_measure[at.element];
    const Curved frame = mesh.frame_of(at.element);
    if (corners.size() == 3)
      out.triangles.push_back({after(1), after(2), reference, frame.normal, frame.against});
    else
      out.quadrilaterals.push_back({after(1), after(2), after(3), reference, frame.normal, frame.mostly_flat, frame.against});
  }
  out.scale = extent > 0.0 && std::isfinite(extent) ? extent : 1.0;
  const double inverse = 1.0 / out.scale;
  const auto rescale = [inverse](auto& element) {
    element.b = inverse * element.b;
    element.c = inverse * element.c;
    element.reference = element.reference * inverse * inverse;
  };
  for (SurfaceTriangle& t : out.triangles) rescale(t);
  for (SurfaceQuadrilateral& q : out.quadrilaterals) rescale(q), q.d = inverse * q.d;
}

}  // namespace dmoscope
