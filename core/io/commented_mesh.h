#pragma once
// Writes a mesh with a comment that says where it comes from.

#include <string>
#include <string_view>
#include <vector>

#include "core/io/mesh_io.h"

namespace dmoscope {

/// A comment as it stands at the end of a file of a format (FormatInfo::name), one line; empty where the format has no comments there.
[[nodiscard]] std::string trailing_comment(std::string_view format, std::string_view comment);

/// write_mesh() with a comment at the file's end (empty: none). A format without comments gets a sentence among those that are returned.
std::vector<std::string> write_commented_mesh(const std::filesystem::path& path, const Mesh& mesh, const MovedMesh& moved,
                                              const IoContext& context, std::string_view comment);

}  // namespace dmoscope
