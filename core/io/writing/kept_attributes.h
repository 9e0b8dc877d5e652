#pragma once
// Attributes that a file takes over from the one that it replaces.

#include <filesystem>

#include <sys/stat.h>

namespace dmoscope {

/// Gives an open file the permissions of another and, if the system allows it, its owner, its group and its extended attributes (with
/// access lists). Returns 0, or the system's error if the permissions cannot be given.
[[nodiscard]] int keep_attributes(const std::filesystem::path& from, const struct stat& status, int descriptor);

}  // namespace dmoscope
