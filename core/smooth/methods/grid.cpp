#include "core/smooth/methods/grid.h"

#include "core/smooth/kernels/compiled/kernel_set.h"

namespace dmoscope {

Grid::Grid(const SmoothingTask& task, const CompositeObjective& objective)
    : parameters_(task.search), flat_aims_(search_for<Plane>(objective, task.search)) {
  if (task.input->is_surface() && task.search.precision != Precision::Double && is_for_kernels(objective))
    flat_kernel_ = kernels(task.search).in<Plane>().composite(objective.first);
}

std::optional<Vec2<double>> Grid::from_above(const SurfacePlaces<Curved>& places, const SurfaceStar& star) const {
  if (flat_kernel_ == nullptr) return std::nullopt;
  thread_local Star<double> flat;  // kept: a visit allocates nothing
  flat.triangles.clear();
  flat.quadrilaterals.clear();
  const auto project = [&](Vec3 p) { return places.plane().project(p); };
  for (const SurfaceTriangle& t : star.triangles) {
    const Vec2<double> b = project(t.b), c = project(t.c);
    flat.triangles.push_back(cross(b, c) > 0.0 ? StarTriangle<double>{b, c, 1.0} : StarTriangle<double>{c, b, 1.0});
  }
  for (const SurfaceQuadrilateral& q : star.quadrilaterals) {
    const Vec2<double> b = project(q.b), c = project(q.c), d = project(q.d);
    flat.quadrilaterals.push_back(cross(c, d - b) > 0.0 ? StarQuadrilateral<double>{b, c, d, 1.0}
                                                        : StarQuadrilateral<double>{d, c, b, 1.0});
  }
  CompositeSearch<Plane> task = flat_aims_;
  task.star = lists_of(flat);
  task.box = places.box();
  const CompositeFound<Plane> found = flat_kernel_(task);
  return found.ready ? std::optional(places.way(found.offset)) : std::nullopt;
}

}  // namespace dmoscope
