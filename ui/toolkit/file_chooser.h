#pragma once
// The desktop's own file dialog, run as a separate program: zenity or kdialog, if one is installed.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dmoscope::ui {

struct ChooserWish {
  bool save = false;  // choose a file to save, else an existing one
  std::string title;
  std::string folder, name;          // folder and name to begin with
  std::string filter_title;          // "meshes and sessions"
  std::vector<std::string> endings;  // ".off"; empty: all files
  bool several = false;              // more than one file may be chosen to be opened
};

struct ChooserOutcome {
  enum class Kind { Chosen, Cancelled, Failed };
  Kind kind = Kind::Cancelled;
  std::vector<std::filesystem::path> paths{};  // chosen files: at least one for Chosen
  std::string trouble{};                       // a sentence for Failed
};

/// The program that shows the desktop's file dialog, found on $PATH: kdialog first if $XDG_CURRENT_DESKTOP names KDE, else zenity. Empty if
/// there is none.
[[nodiscard]] std::filesystem::path chooser_program();
/// Command line of the program, the program first.
[[nodiscard]] std::vector<std::string> chooser_arguments(const std::filesystem::path& program, const ChooserWish& wish);

/// The desktop's file dialog, one at a time; the window goes on meanwhile.
class FileChooser {
 public:
  FileChooser();
  /// Closes the dialog.
  ~FileChooser();
  FileChooser(const FileChooser&) = delete;
  FileChooser& operator=(const FileChooser&) = delete;

  /// Opens a dialog, in place of another that may be open. `wake`: called from another thread when there is something to take. False with a
  /// sentence in `trouble`: the program cannot be started.
  [[nodiscard]] bool begin(const ChooserWish& wish, std::function<void()> wake, std::string& trouble);
  [[nodiscard]] bool open() const;
  /// Closes the open dialog; there is no outcome then.
  void cancel();
  /// Outcome of the dialog, once.
  [[nodiscard]] std::optional<ChooserOutcome> take();

 private:
  struct Child;
  std::unique_ptr<Child> child_;
};

}  // namespace dmoscope::ui
