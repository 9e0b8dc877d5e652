#pragma once
// Meshes in a saved session, and how to find them again.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/session/input_marks.h"
#include "core/session/json_values.h"
#include "core/session/session_standing.h"

namespace dmoscope {

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
