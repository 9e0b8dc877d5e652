#pragma once
// Preparation of a mesh that was read or made: orients, examines and indexes it; used by prepare_input() and load_input().

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"

namespace dmoscope {

/// Prepares a mesh like prepare_input(); `notes`: sentences that come first in the report.
[[nodiscard]] std::shared_ptr<const InputMesh> prepare(Mesh mesh, std::filesystem::path path, Need need, Progress& progress,
                                                       std::string generator, std::vector<std::string> notes);

}  // namespace dmoscope
