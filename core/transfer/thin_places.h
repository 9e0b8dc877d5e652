#pragma once
// Where the back of a mesh one cell thick goes when its front has moved.

#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"

namespace dmoscope {

/// The positions with each vertex of the back behind its partner, as far and in the direction as the input's back is behind that place of
/// its front: linear in the triangles of the front, so that a back that is parallel, or a plane of its own, stays so. What has not moved
/// keeps every bit. Of a mesh that is not of front faces alone (thin.h) the positions themselves. Throws Cancelled.
[[nodiscard]] std::vector<Vec3> places_with_back(const InputMesh& input, std::span<const Vec3> positions, ThreadPool* pool,
                                                 Progress& progress);

}  // namespace dmoscope
