#pragma once
// Where a dialog is to save, and whether it can.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope::ui {

/// What a person typed and chose; it stays as it is whatever comes of it.
struct SaveTarget {
  std::string folder;    // where a name without one goes
  std::string name;      // a name in the folder, or a path
  std::string asked;     // the file of which it was asked whether to replace it; empty: none
  std::string replaced;  // the file that may be replaced, as was answered
  std::string trouble;   // why the last try was refused; empty: it was not

  /// The whole path of a name; "~" is the home. Empty for an empty name.
  [[nodiscard]] std::filesystem::path path() const;
  /// Takes a whole path: folder and name.
  void set_path(const std::filesystem::path& path);
};

/// The endings that a dialog may write, such as ".png"; the first one is added to a name without any.
struct SaveEndings {
  std::string_view what;  // "a screenshot"
  std::vector<std::string> endings;
  bool meshes = false;  // any format of a mesh besides, packed or not
};

enum class SaveVerdict {
  Ready,   // can be written
  Asks,    // there is such a file: `asked` names it, and `replaced` must become the same before anything is written
  Refused  // `trouble` says why
};
/// Judges a target before it is written to, and gives a name without an ending the first one.
[[nodiscard]] SaveVerdict judge(SaveTarget& target, const SaveEndings& endings);

/// A folder to go to by one click.
struct Place {
  std::string title;  // "Home"
  std::string folder;
  friend bool operator==(const Place&, const Place&) = default;
};
/// The home, the mesh's folder, the working directory and the folders of recent files, each once; those that are there.
/// `mesh`: the open mesh's file, empty where it has none.
[[nodiscard]] std::vector<Place> places(const std::filesystem::path& mesh, std::span<const std::string> recent_files);
/// Where a dialog starts: beside the open mesh, else in the working directory.
[[nodiscard]] std::string first_folder(const std::filesystem::path& mesh);

}  // namespace dmoscope::ui
