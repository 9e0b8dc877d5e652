#pragma once
// Formats that are not read, recognised by the begin of a file, so that a message can name the format and a remedy.

#include <filesystem>
#include <string>
#include <string_view>

namespace dmoscope {

/// Sentence on a file that no reader accepted, and how to convert it: "this is an MFEM mesh, which is not read: save it ..." Empty if its
/// format is unknown. `extension`: ".msh", in whatever case. Examines only the first 64 kB.
[[nodiscard]] std::string foreign_format(std::string_view bytes, std::string_view extension);
/// Names the format of a folder whose files no reader takes, and says how to convert it; empty for a file and for an unknown format.
[[nodiscard]] std::string foreign_folder(const std::filesystem::path& path);

}  // namespace dmoscope
