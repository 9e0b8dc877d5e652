#pragma once
// Temporary files of this program: their names, and what becomes of those that a killed process left.

#include <filesystem>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace dmoscope {

/// ".dmoscope-PID-N.tmp".
[[nodiscard]] std::string litter_name(pid_t process, unsigned number);
/// Whether a file's name is one of these.
[[nodiscard]] bool is_litter_name(std::string_view name) noexcept;

/// Removes the temporary files in a folder (empty: the current one) that nobody has locked. Never fails: what cannot be removed stays.
void remove_litter(const std::filesystem::path& folder) noexcept;

}  // namespace dmoscope
