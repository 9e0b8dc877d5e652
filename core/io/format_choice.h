#pragma once
// Choice of a file's format, by its name and its first bytes.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/io/format.h"

namespace dmoscope {

inline constexpr std::string_view kPacked = ".gz";  // extension of a file packed by gzip

/// Whether it is one of the format's extensions. Formats that share an extension are distinguished by content.
[[nodiscard]] bool has_extension(const FormatHandler& handler, std::string_view extension);
/// The first format with this extension (".off", in whatever case), null if there is none.
[[nodiscard]] const FormatHandler* by_extension(std::string_view extension);
/// List of all formats: "off (.off), obj (.obj), ...".
[[nodiscard]] std::string known_formats();
/// Whether these bytes certainly begin a file of the format.
[[nodiscard]] bool is_certain(const FormatHandler& handler, std::string_view bytes);
/// The format of a file. Throws InputError if none is known that the file may have.
[[nodiscard]] const FormatHandler& format_of(const std::filesystem::path& path, std::string_view bytes);
/// The unpacked bytes of a file. `size`: gets the size of the file itself.
[[nodiscard]] FileBytes read_unpacked(const std::filesystem::path& path, const IoContext& context, std::size_t& size);

/// The file with the coordinates, for a path that may name its companion. `handler` may be null.
[[nodiscard]] std::filesystem::path main_path(const std::filesystem::path& path, const FormatHandler* handler);
[[nodiscard]] std::filesystem::path companion_path(const std::filesystem::path& main, const CompanionFile& companion);

// Formats that are not read, recognised by the begin of a file, so that a message can name the format and a remedy.

/// Sentence on a file that no reader accepted, and how to convert it: "this is an MFEM mesh, which is not read: save it ..." Empty if its
/// format is unknown. `extension`: ".msh", in whatever case. Examines only the first 64 kB.
[[nodiscard]] std::string foreign_format(std::string_view bytes, std::string_view extension);
/// Names the format of a folder whose files no reader takes, and says how to convert it; empty for a file and for an unknown format.
[[nodiscard]] std::string foreign_folder(const std::filesystem::path& path);

}  // namespace dmoscope
