#pragma once
// Common parts of visits in the plane and in space that read their star straight from the mesh.

#include <limits>

#include "core/numeric/scalar.h"
#include "gpu/lane.h"
#include "gpu/task.h"

namespace dmoscope::gpu::bodies {

inline DMOSCOPE_LANE bool is_number(double a) { return scalar::abs(a) <= std::numeric_limits<double>::max(); }
/// Whether an offset is not zero and its coordinates are numbers.
inline DMOSCOPE_LANE bool leads_away(Vec2<double> a) { return !(a == Vec2<double>{}) && is_number(a.x) && is_number(a.y); }
inline DMOSCOPE_LANE bool leads_away(Vec3 a) { return !(a == Vec3{}) && is_number(a.x) && is_number(a.y) && is_number(a.z); }

/// Moves the vertex. The vertices of its star stay awake or wake; none of them is of its class.
template <class Frame>
DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void move(const Task& task, const MeshView<Frame>& mesh, Index rank, Vec3 to) {
  task.ranked[rank] = to;
  for (const Incidence& at : mesh.star(task.vertex_of_rank[rank]))
    for (const Index other : mesh.corners_of(at.element)) set_flag(task.awake + task.rank_of_vertex[other], true);
  (void)increment(task.moved);
}

}  // namespace dmoscope::gpu::bodies
