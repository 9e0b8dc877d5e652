#pragma once
// The nodal fields of a mesh where its vertices have gone.

#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/mesh/moved_mesh.h"
#include "core/transfer/field_rules.h"

namespace dmoscope {

/// What became of the fields of vertices.
struct MovedFields {
  std::vector<FieldValues> values;                  // of those that changed
  std::vector<std::string> placed, whole, carried;  // names: taken anew; carried as whole numbers; carried as a rule says
  /// "depth was taken anew at the new places (linear in the input's elements); id was carried (whole numbers)"; empty without fields.
  [[nodiscard]] std::string sentence() const;
};

/// What the input has at the vertices' new places: linear in the triangle or tetrahedron that holds it, on a curved surface in the nearest
/// one; outside of the mesh what it has at the nearest place. Metric tensors are interpolated by their logarithms, and stay positive
/// definite. What the back of a mesh one cell thick (thin.h) has is taken from the back. A vertex that has not moved keeps every bit; one
/// without a value (not a number) gets none, and one keeps its own where a corner has none. Throws UsageError for rules of fields that are
/// not there, Cancelled.
[[nodiscard]] MovedFields move_fields(const InputMesh& input, const FieldRules& rules, std::span<const Vec3> positions, ThreadPool* pool,
                                      Progress& progress);

}  // namespace dmoscope
