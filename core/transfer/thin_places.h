#pragma once
// Positions of the back of a mesh one cell thick after its front has moved.

#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"

namespace dmoscope {

/// The positions with each vertex of the back behind its partner, at the offset of the input's back from that place of its front: linear in
/// the triangles of the front, so that a back that is parallel, or a plane of its own, stays so. Vertices that have not moved keep every
/// bit. For a mesh that does not consist of front faces (thin.h) the positions themselves. Throws Cancelled.
[[nodiscard]] std::vector<Vec3> places_with_back(const InputMesh& input, std::span<const Vec3> positions, ThreadPool* pool,
                                                 Progress& progress);

}  // namespace dmoscope
