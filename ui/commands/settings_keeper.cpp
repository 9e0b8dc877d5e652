#include "ui/commands/settings_keeper.h"

#include <cmath>
#include <utility>

#include "ui/commands/settings.h"

namespace dmoscope::ui {

void SettingsKeeper::begin(std::filesystem::path settings, std::filesystem::path recent, ViewState& state) {
  settings_ = std::move(settings);
  recent_ = std::move(recent);
  load_settings(settings_, state);
  load_recent(recent_, state);
  written_ = seen_ = settings_text(state);
  written_recent_ = state.recent_files;
}

double SettingsKeeper::look(ViewState& state, double now) {
  const std::string text = settings_text(state);
  if (text != seen_) {
    seen_ = text;
    since_ = now;
  }
  const bool waits = text != written_, still = now - since_ >= kStill;
  if ((waits && still) || state.recent_files != written_recent_) {
    for (const std::string& trouble : write(state)) {
      if (std::exchange(said_, trouble) != trouble) add_message(state, {Message::Kind::Warning, trouble, 0});
    }
    return INFINITY;
  }
  return waits ? kStill - (now - since_) : INFINITY;
}

std::vector<std::string> SettingsKeeper::write(const ViewState& state) {
  std::vector<std::string> troubles;
  // After a failure, writing is not tried again until something changes.
  if (std::string text = settings_text(state); text != written_) {
    if (std::string trouble = save_settings(settings_, state); !trouble.empty()) troubles.push_back(std::move(trouble));
    written_ = seen_ = std::move(text);
  }
  if (state.recent_files != written_recent_) {
    if (std::string trouble = save_recent(recent_, state); !trouble.empty()) troubles.push_back(std::move(trouble));
    written_recent_ = state.recent_files;
  }
  return troubles;
}

}  // namespace dmoscope::ui
