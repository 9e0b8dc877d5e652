#pragma once
// Writing of meshes with a comment on their origin.

#include <string>
#include <string_view>
#include <vector>

#include "core/io/mesh_io.h"

namespace dmoscope {

/// A comment in the form for the end of a file of a format (FormatInfo::name), one line; empty if the format has no comments there.
[[nodiscard]] std::string trailing_comment(std::string_view format, std::string_view comment);

/// Writes a mesh like write_mesh() with a comment at the file's end (empty: none). For a format without comments a sentence is added to
/// those returned.
std::vector<std::string> write_commented_mesh(const std::filesystem::path& path, const Mesh& mesh, const MovedMesh& moved,
                                              const IoContext& context, std::string_view comment);

}  // namespace dmoscope
