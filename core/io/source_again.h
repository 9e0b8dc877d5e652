#pragma once
// Which way write_mesh() goes.

#include <filesystem>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Does write_mesh() write the bytes of mesh.source to `path` again, with the coordinates replaced in which its positions differ from
/// mesh.positions, which have to be the file's? Else it makes the file anew.
[[nodiscard]] bool writes_source_again(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace dmoscope
