#pragma once
// Common part of all dialogs that save: folder, places, name, Browse, and the question before a file is replaced.

#include <string>

#include "ui/panels/panel_context.h"

namespace dmoscope::ui {

/// Texts and endings of such a dialog.
struct SaveForm {
  SaveRows& rows;
  SaveEndings endings;
  Dialog dialog;
  std::string items;   // prefix of its items' names: "export:file", ...
  float label_em = 6;  // width of the labels
};

/// Prepares the form when its dialog opens: the folder of the open mesh, and its name unless another one was typed for this mesh.
void begin_save(PanelContext& context, SaveRows& rows, const std::string& name);
/// A name beside the open mesh's file: "east-smoothed.14" for "-smoothed" and "" (its own ending).
[[nodiscard]] std::string name_beside(const PanelContext& context, const std::string& add, const std::string& ending);
/// Draws folder and name. True: Enter was pressed in the name.
[[nodiscard]] bool draw_save_rows(PanelContext& context, const SaveForm& form);
/// Draws trouble or question, and the buttons. True: the target is to be written now, and the dialog is closed.
[[nodiscard]] bool draw_save_buttons(PanelContext& context, const SaveForm& form, const char* verb, bool entered);
/// A path, cut to its end if there is not enough room.
[[nodiscard]] std::string fit_path(const std::string& path, float width);
/// Draws a text field for a file's name, whatever letters that has.
[[nodiscard]] bool path_field(PanelContext& context, const char* label, std::string& text);

}  // namespace dmoscope::ui
