#pragma once
// Meshes in a saved session, and how to find them again.

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/reference/standing.h"
#include "core/session/json_values.h"
#include "core/session/session_standing.h"
#include "core/smooth/size_field.h"

namespace dmoscope {

// Hashes of a run's inputs besides positions and elements. A run that is continued must find the same in its input mesh.

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

struct OpenedMesh {
  std::shared_ptr<const InputMesh> input;
  std::vector<DataMark> data;
};

/// Opens the meshes of a saved session: one as "input", several as "inputs". `input`: see open_state(). Throws UsageError and InputError.
[[nodiscard]] std::vector<OpenedMesh> to_meshes(const StateJson& json, const std::filesystem::path& path, const IoContext& context,
                                                const std::shared_ptr<const InputMesh>& input);

/// Description of a mesh in a saved session, to find it again. Throws UsageError for one that cannot be found again.
[[nodiscard]] StateJson input_json(const MeshStanding& mesh);

}  // namespace dmoscope
