#pragma once
// Hashes of a run's inputs besides positions and elements. A run that is continued must find the same in its input mesh.

#include <string>
#include <utility>
#include <vector>

#include "core/reference/standing.h"
#include "core/smooth/size_field.h"

namespace dmoscope {

/// Hash of the vertices that stay by rule, without those that the user fixes.
[[nodiscard]] std::string standing_mark(const InputMesh& input, const StandingRule& rule);

/// Hash of the nodal field that a size function reads; empty if it reads none.
[[nodiscard]] std::string size_mark(const InputMesh& input, const SizeField* size);

/// Name of a group or field of the file, as the user reads it (group "steel", field "mat_id"), and its hash.
using DataMark = std::pair<std::string, std::string>;

/// Marks of all data that can fix vertices: groups, and fields that name materials; in the mesh's order.
[[nodiscard]] std::vector<DataMark> data_marks(const Mesh& mesh);

/// Phrase on the differences: `group "steel" has changed, field "mat_id" is gone`; of many the first few. Empty if there are none.
[[nodiscard]] std::string changed_data(const std::vector<DataMark>& then, const std::vector<DataMark>& now);

}  // namespace dmoscope
