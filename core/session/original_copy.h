#pragma once
// Copies of files that are about to be overwritten.

#include <filesystem>
#include <span>
#include <vector>

namespace dmoscope {

/// Name for a copy of a file: "east.orig.14", then "east.orig2.14", ...; the format's extension stays, so that it can be opened.
[[nodiscard]] std::filesystem::path original_name(const std::filesystem::path& file, unsigned number);

/// Copies each of these files beside itself, all under the first number that is free for all of them, so that no older copy is overwritten.
/// Missing files are skipped. Returns the copies' names, in the order of the files; empty for a missing one. Throws OutputError, and then
/// leaves none of the copies.
[[nodiscard]] std::vector<std::filesystem::path> keep_originals(std::span<const std::filesystem::path> files);

}  // namespace dmoscope
