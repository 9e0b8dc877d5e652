#pragma once
// Files and folders for the open dialog; recent files; and the file that is being read.

#include <filesystem>
#include <optional>
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

/// Extension of saved sessions.
inline constexpr std::string_view kSessionExtension = ".dmoscope";
/// The command that opens a mesh or a session, by its name.
[[nodiscard]] std::string open_command(const std::string& file);
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

struct RecentFile {
  std::string path;
  bool missing = false;
  /// Reason why it cannot be opened; empty when it can.
  [[nodiscard]] std::string reason() const { return missing ? path + ": this file is not there any more" : std::string(); }
};

/// Recent files that ask the file system now and then, not at every frame.
class RecentFiles {
 public:
  static constexpr double kSeconds = 2.0;
  /// The files with the facts known at `now` (seconds).
  [[nodiscard]] const std::vector<RecentFile>& list(const std::vector<std::string>& files, double now);

 private:
  std::vector<RecentFile> files_;
  double asked_ = -1e9;
};

struct BeingRead {
  std::string name;   // "east.14"; "sample coast"
  std::string where;  // "184.2 MB in /home/me/meshes"; empty if there is no file
};

/// Mesh that a command of the session brings; none: it opens nothing. Reads the file's size.
[[nodiscard]] std::optional<BeingRead> being_read(std::string_view command);

}  // namespace dmoscope::ui
