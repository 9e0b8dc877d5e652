// The desktop's file dialog in place of the program's own, if there is one.
#include <algorithm>
#include <string_view>
#include <utility>

#include "core/io/mesh_io.h"
#include "ui/app.h"

namespace dmoscope::ui {

/// The target of a dialog that saves.
SaveRows* App::rows_of(Dialog dialog) {
  return dialog == Dialog::Export        ? &widgets_.exporting.save
         : dialog == Dialog::Screenshot  ? &widgets_.screenshot.save
         : dialog == Dialog::Plot        ? &widgets_.plot_dialog.save
         : dialog == Dialog::SaveSession ? &widgets_.save_session.save
                                         : nullptr;
}

void App::take_chosen_file() {
  const std::optional<ChooserOutcome> outcome = chooser_.take();
  if (!outcome) return;
  const Dialog asked_by = widgets_.chooser.asked_by;
  SaveRows* rows = rows_of(asked_by);
  switch (outcome->kind) {
    case ChooserOutcome::Kind::Cancelled:
      return;
    case ChooserOutcome::Kind::Failed:
      add_message(state_, {Message::Kind::Warning, outcome->trouble + "; this is dmoscope's own", 0});
      chooser_failed_ = true;
      if (rows != nullptr) {
        rows->browsing = state_.dialog == asked_by;
      } else if (state_.dialog == Dialog::None) {
        state_.dialog = Dialog::Open;
      }
      return;
    case ChooserOutcome::Kind::Chosen:
      if (rows == nullptr) {
        for (const std::string& command : commands_to_open(state_.open_for, outcome->paths)) submit_by_person(command);
      } else {
        rows->target.set_path(outcome->paths.front());
        ++rows->taken;
        rows->target.replaced = rows->target.path().string();  // the desktop's dialog has asked
      }
  }
}

/// Opens the desktop's dialog if the program's own was asked for, or wants it to choose a folder.
void App::serve_chooser() {
  ChooserTurn& turn = widgets_.chooser;
  turn.usable = options_.native_dialogs && state_.native_dialogs && !chooser_failed_ && !chooser_program().empty();
  take_chosen_file();
  if (rows_of(turn.asked_by) != nullptr && chooser_.open() && state_.dialog != turn.asked_by) chooser_.cancel();  // its dialog is gone
  if (turn.usable && state_.dialog == Dialog::Open && widgets_.dialog_shown != Dialog::Open) {
    state_.dialog = Dialog::None;
    const std::filesystem::path mesh = session_->input ? session_->input->path : std::filesystem::path();
    ChooserWish wish{false, title_to_open(state_.open_for), first_folder(mesh),
                     {},    "meshes and sessions",          {std::string(kSessionExtension)}};
    for (const FormatInfo& format : format_table()) {
      std::string_view rest = format.extensions;
      while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        for (const char* packed : {"", ".gz"}) wish.endings.push_back(std::string(rest.substr(0, end)) + packed);
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
    }
    wish.several = state_.open_for != OpenFor::Surface;
    turn.wish = std::move(wish);
    turn.asked_by = Dialog::Open;
  }
  if (!turn.wish) {
    turn.open = chooser_.open();
    return;
  }
  std::string trouble;
  if (chooser_.begin(*std::exchange(turn.wish, std::nullopt), wake_, trouble)) {
    add_message(state_, {Message::Kind::Info, "choose a file in the desktop's dialog", 0});
  } else {
    add_message(state_, {Message::Kind::Warning, trouble + "; this is dmoscope's own dialog", 0});
    chooser_failed_ = true;
    if (turn.asked_by == Dialog::Open) state_.dialog = Dialog::Open;
    if (SaveRows* rows = rows_of(turn.asked_by)) rows->browsing = true;
  }
  turn.open = chooser_.open();
}

}  // namespace dmoscope::ui
