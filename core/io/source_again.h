#pragma once
// Choice between patching and writing a new file.

#include <filesystem>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Whether write_mesh() writes the bytes of mesh.source to `path` again, with changed coordinates replaced; mesh.positions must be the
/// file's own. Otherwise it writes a new file.
[[nodiscard]] bool writes_source_again(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace dmoscope
