#pragma once
// The file that a dialog is to save, and whether it can be written.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope::ui {

/// Folder and name that a person typed and chose; they stay whatever comes of them.
struct SaveTarget {
  std::string folder;    // folder for a name without one
  std::string name;      // a name in the folder, or a path
  std::string asked;     // file for which the person was asked whether to replace it; empty: none
  std::string replaced;  // file that the person allowed to be replaced
  std::string trouble;   // reason why the last try was refused; empty: it was not

  /// Whole path of the name; "~" is the home. Empty for an empty name.
  [[nodiscard]] std::filesystem::path path() const;
  /// Sets folder and name from a whole path.
  void set_path(const std::filesystem::path& path);
};

/// The endings that a dialog may write, such as ".png"; the first one is added to a name without any.
struct SaveEndings {
  std::string_view what;  // thing to be saved: "a screenshot"
  std::vector<std::string> endings;
  bool meshes = false;  // also any format of a mesh, packed or not
};

enum class SaveVerdict {
  Ready,   // can be written
  Asks,    // the file exists: `asked` names it, and `replaced` must become the same before anything is written
  Refused  // `trouble` says why not
};
/// Judges a target before it is written, and adds the first ending to a name without one.
[[nodiscard]] SaveVerdict judge(SaveTarget& target, const SaveEndings& endings);

/// A folder to go to by one click.
struct Place {
  std::string title;  // "Home"
  std::string folder;
  friend bool operator==(const Place&, const Place&) = default;
};
/// The home, the mesh's folder, the working directory and the folders of recent files, each once; only existing ones. `mesh`: file of the
/// open mesh, empty if it has none.
[[nodiscard]] std::vector<Place> places(const std::filesystem::path& mesh, std::span<const std::string> recent_files);
/// Folder that a dialog starts in: that of the open mesh, else the working directory.
[[nodiscard]] std::string first_folder(const std::filesystem::path& mesh);

}  // namespace dmoscope::ui
