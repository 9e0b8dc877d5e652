#pragma once
// Names of this program's temporary files, and removal of those that a killed process left.

#include <filesystem>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace dmoscope {

/// Name of a temporary file: ".dmoscope-PID-N.tmp".
[[nodiscard]] std::string litter_name(pid_t process, unsigned number);
/// Whether a file's name is one of these.
[[nodiscard]] bool is_litter_name(std::string_view name) noexcept;

/// Removes the temporary files in a folder (empty: the current one) that no process has locked. Never fails: files that cannot be removed
/// stay.
void remove_litter(const std::filesystem::path& folder) noexcept;

}  // namespace dmoscope
