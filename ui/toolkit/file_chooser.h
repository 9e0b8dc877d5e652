#pragma once
// The desktop's own file dialog, as a program beside ours: zenity or kdialog, where one is installed.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dmoscope::ui {

struct ChooserWish {
  bool save = false;  // else a file that is there
  std::string title;
  std::string folder, name;          // where it begins
  std::string filter_title;          // "meshes and sessions"
  std::vector<std::string> endings;  // ".off"; empty: all files
  bool several = false;              // more than one may be chosen to be opened
};

struct ChooserOutcome {
  enum class Kind { Chosen, Cancelled, Failed };
  Kind kind = Kind::Cancelled;
  std::vector<std::filesystem::path> paths{};  // of Chosen: at least one
  std::string trouble{};                       // of Failed: a sentence
};

/// The program that shows the desktop's file dialog, found on $PATH: kdialog first where $XDG_CURRENT_DESKTOP names KDE, else zenity.
/// Empty where there is none.
[[nodiscard]] std::filesystem::path chooser_program();
/// Its arguments, the program first.
[[nodiscard]] std::vector<std::string> chooser_arguments(const std::filesystem::path& program, const ChooserWish& wish);

/// One such dialog at a time; the window goes on meanwhile.
class FileChooser {
 public:
  FileChooser();
  /// Ends the dialog.
  ~FileChooser();
  FileChooser(const FileChooser&) = delete;
  FileChooser& operator=(const FileChooser&) = delete;

  /// Shows one, in place of another that may be open. `wake`: called from another thread when there is something to take. False with a
  /// sentence in `trouble`: the program cannot be started.
  [[nodiscard]] bool begin(const ChooserWish& wish, std::function<void()> wake, std::string& trouble);
  [[nodiscard]] bool open() const;
  /// Ends the dialog that is open; nothing is to be taken then.
  void cancel();
  /// What came of it, once.
  [[nodiscard]] std::optional<ChooserOutcome> take();

 private:
  struct Child;
  std::unique_ptr<Child> child_;
};

}  // namespace dmoscope::ui
