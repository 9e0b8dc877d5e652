#pragma once
// What a file keeps of the one that it replaces.

#include <filesystem>

#include <sys/stat.h>

namespace dmoscope {

/// Gives an open file the permissions of another and, where the system lets us, its owner, its group and its extended attributes (access
/// lists are among them). Returns 0, or the system's error where the permissions cannot be given.
[[nodiscard]] int keep_attributes(const std::filesystem::path& from, const struct stat& status, int descriptor);

}  // namespace dmoscope
