#pragma once
// Files of formats that are not read here, recognised by how they begin, so that a message can say what the file is and what to do with it.

#include <filesystem>
#include <string>
#include <string_view>

namespace dmoscope {

/// What a file is that no reader took, and how to get a mesh from it that one takes: "this is an MFEM mesh, which is not read: save it
/// ..." Empty if nobody knows. `extension`: ".msh", whatever its case. Looks at the first 64 kB only.
[[nodiscard]] std::string foreign_format(std::string_view bytes, std::string_view extension);
/// Names the format of a folder whose files no reader takes, and says how to convert it; empty for a file and for an unknown format.
[[nodiscard]] std::string foreign_folder(const std::filesystem::path& path);

}  // namespace dmoscope
