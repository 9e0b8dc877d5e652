#pragma once
// The dialogs, and their state between frames.

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ui/analysis/metric_choices.h"
#include "ui/state/save_target.h"
#include "ui/state/view_state.h"
#include "ui/toolkit/file_browser.h"
#include "ui/toolkit/file_chooser.h"

namespace dmoscope::ui {

struct PanelContext;

struct OpenDialog {
  std::string folder, text, error;
  std::string mesh;  // mesh beside which it began
  std::vector<FolderEntry> entries;
  int selected = -1;
  std::set<std::string> marked;  // names chosen in the folder, when several can be (Ctrl+click, Shift+click)
  bool all_files = false;
};
void draw_open_dialog(PanelContext& context);

/// State of every dialog that saves: typed text stays for the next time, as long as the mesh is the same.
struct SaveRows {
  SaveTarget target;
  std::string mesh;       // mesh whose names are meant
  bool browsing = false;  // whether files are browsed in the dialog itself
  int taken = 0;          // number of times that another name came from elsewhere
  std::vector<FolderEntry> entries;
  std::string listed, list_error;  // folder of these
};

/// The desktop's file dialog: `usable` if there is one; wanted by one of the program's dialogs, or in place of the one for opening.
struct ChooserTurn {
  bool usable = false, open = false;
  std::optional<ChooserWish> wish;
  Dialog asked_by = Dialog::None;
};

struct ExportDialog {
  int what = 0;
  SaveRows save;
  bool over_input = false;  // whether it asks if the mesh's own file may be overwritten
};
void draw_export_dialog(PanelContext& context);

struct ScreenshotDialog {
  SaveRows save;
  int width = 0, height = 0, supersample = 2;
  bool transparent = false, window = false;
};
void draw_screenshot_dialog(PanelContext& context);

struct PaletteDialog {
  std::string text;
  int selected = 0;
};
void draw_palette_dialog(PanelContext& context);

struct FindDialog {
  std::string text;
  int kind = 0;  // 0: a vertex, 1: an element
};
void draw_find_dialog(PanelContext& context);

struct LogDialog {
  std::string filter, script_name = "session.txt";
  bool commands = true, messages = true;
  std::size_t seen = 0;  // number of lines in the last frame
};
void draw_log_dialog(PanelContext& context);

/// State of the dialog for a sequence of pictures.
struct SequenceDialog {
  std::string folder = "pictures";
  int from = 0, to = 0, every = 1, width = 0, height = 0;
  bool window = false, overwrite = false;
};
void draw_sequence_dialog(PanelContext& context);

/// Runs to be made beside the active run.
struct CompareDialog {
  std::set<std::string> methods, metrics;  // names of the chosen ones
  bool until_converged = true;
  int iterations = 20;
};
void draw_compare_dialog(PanelContext& context);

/// State of the dialog that saves a plot.
struct PlotDialog {
  SaveRows save;
  int width = 800, height = 450, scale = 2;
};
void draw_plot_dialog(PanelContext& context);

struct SaveSessionDialog {
  SaveRows save;
};
void draw_save_session_dialog(PanelContext& context);

/// Draws the question before unsaved work is given up.
void draw_unsaved_dialog(PanelContext& context);

struct RecoverDialog {
  std::size_t chosen = 0;
};
void draw_recover_dialog(PanelContext& context);

/// State of the dialog for a metric by a formula and a target.
struct FormulaDialog {
  std::string text, target;
  FormulaCheck check;
};
void draw_formula_dialog(PanelContext& context);

void draw_keys_dialog(PanelContext& context);
void draw_about_dialog(PanelContext& context);
void draw_error_dialog(PanelContext& context);

/// The targets that fit a mesh, found once for each.
class TargetChoices {
 public:
  [[nodiscard]] const std::vector<TargetChoice>& of(const std::shared_ptr<const InputMesh>& input);

 private:
  std::shared_ptr<const InputMesh> input_;
  std::vector<TargetChoice> choices_;
};

/// Draws the open dialog, if any.
void draw_dialogs(PanelContext& context);

/// Begins a modal window of the open dialog; false when it is closed. Escape closes it.
bool begin_dialog(PanelContext& context, const char* title, float width_em, float height_em = 0);
void end_dialog();

}  // namespace dmoscope::ui
