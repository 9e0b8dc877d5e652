#pragma once
// Common parts of visits in the plane and in space that read their star straight from the mesh.

#include <limits>

#include "core/numeric/scalar.h"
#include "core/quality/element_shape.h"
#include "core/quality/validity.h"
#include "core/smooth/reference_visit.h"
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

/// Ends a visit: moves the vertex by `offset`, or by a part of it, where confirm(place) says that it gains; otherwise puts it to sleep.
template <class Frame, class Confirm>
DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void settle(const Task& task, const MeshView<Frame>& mesh, Index rank, OffsetIn<Frame, double> offset,
                                               const Confirm& confirm) {
  const Vec3 here = positions_of(task)[task.vertex_of_rank[rank]];
  ConfirmedMove found;
  if (leads_away(offset))
    found = confirmed_move(
        offset, [&](const auto& step) DMOSCOPE_INLINE_LAMBDA { return displaced(mesh.frame, here, step, task.frame.single_precision); },
        confirm);
  if (found.gains && !(found.to == here))
    move(task, mesh, rank, found.to);
  else
    set_flag(task.awake + rank, false);
}

/// Judges an element, one per lane: its quality and whether it is inverted.
template <Metric M, class Frame>
struct Judge {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    const auto element = static_cast<Index>(task.first + i);
    const PositionView positions = positions_of(task);
    const MeshView<Frame> mesh = mesh_in<Frame>(task);
    visit_shape(
        mesh.frame_of(element), mesh.corners_of(element), [&](Index v) { return positions[v]; },
        [&](const auto& shape) {
          task.quality[element] = evaluate<M>(shape);
          task.inverted[element] = least_jacobian(shape) <= 0.0 ? 1 : 0;
        });
  }
};

}  // namespace dmoscope::gpu::bodies
