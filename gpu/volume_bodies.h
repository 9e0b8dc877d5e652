#pragma once
// The kernels' bodies for volumes.

#include "core/quality/element_shape.h"
#include "core/quality/validity.h"
#include "core/smooth/reference_visit.h"
#include "gpu/lane.h"
#include "gpu/listed_star.h"
#include "gpu/star_visit.h"
#include "gpu/task.h"
#include "gpu/volume_search.h"
#include "gpu/work.h"

namespace dmoscope::gpu::bodies {

/// Visits the vertex of rank first + i by the fast search, or by the plain one if that cannot handle the star or the search is to be in
/// double.
template <Metric M>
struct VisitVolume {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& team) {
    const auto rank = static_cast<Index>(task.first + i);
    if (!is_set(task.awake + rank)) return;
    const Index vertex = task.vertex_of_rank[rank];
    const ListedStar<Space> star(volume_of(task), positions_of(task), vertex);
    const Vec3 found = search(task, vertex, star, team);
    if (team.lane() != 0) return;
    settle(task, volume_of(task), rank, times(found, star.star().scale()),
           [&](Vec3 to) DMOSCOPE_INLINE_LAMBDA { return confirm_at<M>(volume_of(task), positions_of(task), vertex, to, task.untangling); });
  }

 private:
  /// Returns the offset of the best candidate in units of the star's scale; 0 if none is better than the vertex's own place.
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE Vec3 search(const Task& task, Index vertex, const ListedStar<Space>& star, const Team& team) {
    const bool plain =
        task.untangling.repair || (task.untangling.looks_inside() && has_inverted(volume_of(task), positions_of(task), vertex));
    if (task.parameters.precision == Precision::Float && !plain && star.fits()) {
      const VolumeFound found = VolumeRankSearch<M, Team>(star.star(), task.parameters, team).run();
      if (found.ready) return {found.offset.x, found.offset.y, found.offset.z};
    }
    return search_star<M>(star, star.star().box(), task.parameters, task.untangling, team);
  }
};

}  // namespace dmoscope::gpu::bodies
