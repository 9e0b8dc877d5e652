#pragma once
// Which format a file has, by its name and its first bytes.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/io/format.h"

namespace dmoscope {

inline constexpr std::string_view kPacked = ".gz";  // the extension of a packed file

/// Is it one of the format's extensions? Some formats share one, and are told apart by content.
[[nodiscard]] bool has_extension(const FormatHandler& handler, std::string_view extension);
/// The first format with this extension (".off", whatever its case), null if there is none.
[[nodiscard]] const FormatHandler* by_extension(std::string_view extension);
/// "off (.off), obj (.obj), ..."
[[nodiscard]] std::string known_formats();
/// Do these bytes certainly begin a file of the format?
[[nodiscard]] bool is_certain(const FormatHandler& handler, std::string_view bytes);
/// Throws InputError where no format is known that the file may have.
[[nodiscard]] const FormatHandler& format_of(const std::filesystem::path& path, std::string_view bytes);
/// Its bytes, unpacked. `size`: of the file itself.
[[nodiscard]] FileBytes read_unpacked(const std::filesystem::path& path, const IoContext& context, std::size_t& size);

/// The file of a format with the coordinates, which `path` may name by its companion. `handler` may be null.
[[nodiscard]] std::filesystem::path main_path(const std::filesystem::path& path, const FormatHandler* handler);
[[nodiscard]] std::filesystem::path companion_path(const std::filesystem::path& main, const CompanionFile& companion);

}  // namespace dmoscope
