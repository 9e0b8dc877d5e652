#pragma once
// Copies of files that are about to be written over.

#include <filesystem>
#include <span>
#include <vector>

namespace dmoscope {

/// What a copy of a file may be called: "east.orig.14", then "east.orig2.14", ...; the format's ending stays, so that it can be opened.
[[nodiscard]] std::filesystem::path original_name(const std::filesystem::path& file, unsigned number);

/// Copies each of these files beside itself, all under the first number that is free for all of them: no older copy is written over.
/// Those that do not exist are passed over. Returns the copies' names, in the order of the files; empty for one without. Throws
/// OutputError; none of the copies is left then.
[[nodiscard]] std::vector<std::filesystem::path> keep_originals(std::span<const std::filesystem::path> files);

}  // namespace dmoscope
