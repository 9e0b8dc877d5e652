#pragma once
// Files and folders for the open dialog.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

struct FolderEntry {
  std::string name;
  bool folder = false;
  std::uintmax_t bytes = 0;
};

/// Whether a name has the extension of a format that can be read.
[[nodiscard]] bool is_mesh_name(std::string_view name);

/// Extension of saved sessions.
inline constexpr std::string_view kSessionExtension = ".dmoscope";
[[nodiscard]] bool is_session_name(std::string_view name);
/// The command that opens a mesh or a session, by its name.
[[nodiscard]] std::string open_command(const std::string& file);
/// The command that opens a mesh beside those that are open; a session in their place.
[[nodiscard]] std::string open_beside_command(const std::string& file);
/// Commands, and title of the dialog, for the role of opened files: a mesh after another is opened beside it.
[[nodiscard]] std::vector<std::string> commands_to_open(OpenFor open_for, const std::vector<std::filesystem::path>& files);
[[nodiscard]] const char* title_to_open(OpenFor open_for);
/// The commands that open several files: a mesh after another is opened beside it.
[[nodiscard]] std::vector<std::string> open_commands(const std::vector<std::filesystem::path>& files);

/// Entries of a folder: folders first, then files, each by name without regard to case; hidden ones left out. Files that are no meshes only
/// when `all`. On failure returns what could be read and puts a sentence into `error`, which is cleared otherwise.
[[nodiscard]] std::vector<FolderEntry> list_folder(const std::filesystem::path& folder, bool all, std::string& error);

/// Text of a size: "12.3 MB".
[[nodiscard]] std::string byte_size(std::uintmax_t bytes);

/// Path of a folder's parent; the folder itself at the root.
[[nodiscard]] std::string parent_folder(const std::string& folder);

}  // namespace dmoscope::ui
