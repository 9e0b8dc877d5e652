#pragma once
// The part that all dialogs share that save: folder, places, name, Browse, and the question before a file is replaced.

#include <string>

#include "ui/panels/panel_context.h"

namespace dmoscope::ui {

/// What such a dialog is about.
struct SaveForm {
  SaveRows& rows;
  SaveEndings endings;
  Dialog dialog;
  std::string items;   // its items are named "export:file", ...
  float label_em = 6;  // width of the labels
};

/// Makes the form ready when its dialog opens: beside the open mesh, under that name unless another one was typed for this mesh.
void begin_save(PanelContext& context, SaveRows& rows, const std::string& name);
/// "east-smoothed.14" of the open mesh's file for "-smoothed" and "" (its own ending).
[[nodiscard]] std::string name_beside(const PanelContext& context, const std::string& add, const std::string& ending);
/// Folder and name. True: Enter was pressed in the name.
[[nodiscard]] bool draw_save_rows(PanelContext& context, const SaveForm& form);
/// What stands in the way, and the buttons. True: the target is to be written now, and the dialog is closed.
[[nodiscard]] bool draw_save_buttons(PanelContext& context, const SaveForm& form, const char* verb, bool entered);
/// Of a path, its end where there is no room for all of it.
[[nodiscard]] std::string fit_path(const std::string& path, float width);
/// A text field for a file's name, whatever letters that has.
[[nodiscard]] bool path_field(PanelContext& context, const char* label, std::string& text);

}  // namespace dmoscope::ui
