#pragma once
// Nodal fields of a mesh at the new positions of its vertices.

#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/mesh/moved_mesh.h"
#include "core/transfer/field_rules.h"

namespace dmoscope {

/// Fields of vertices after a move.
struct MovedFields {
  std::vector<FieldValues> values;                  // values of the fields that changed
  std::vector<std::string> placed, whole, carried;  // names of fields interpolated, carried as whole numbers, carried by a rule
  [[nodiscard]] std::string sentence() const;
};

/// Interpolates the input's nodal fields at the vertices' new places: linearly in the triangle or tetrahedron that holds it, on a curved
/// surface in the nearest one; outside of the mesh at the nearest place. Metric tensors are interpolated by their logarithms, and stay
/// positive definite. Fields on the back of a mesh one cell thick (thin.h) are interpolated on the back. A vertex that has not moved keeps
/// every bit; one without a value (not a number) gets none, and one keeps its own if a corner has none. Throws UsageError for rules of
/// missing fields, Cancelled.
[[nodiscard]] MovedFields move_fields(const InputMesh& input, const FieldRules& rules, std::span<const Vec3> positions, ThreadPool* pool,
                                      Progress& progress);

}  // namespace dmoscope
