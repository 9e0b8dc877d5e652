#pragma once
// Settings that the window keeps between starts.

#include <filesystem>
#include <string>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Path of the settings: $XDG_CONFIG_HOME/dmoscope/settings.json, else ~/.config/dmoscope/settings.json; empty when neither is known.
[[nodiscard]] std::filesystem::path settings_path();

/// Path of the recent files: $XDG_STATE_HOME/dmoscope/recent.json, else ~/.local/state/dmoscope/recent.json; empty when neither is known.
[[nodiscard]] std::filesystem::path recent_path();

/// Folder of sessions that windows save automatically: $XDG_STATE_HOME/dmoscope/autosave, else below ~/.local/state; empty when neither is
/// known.
[[nodiscard]] std::filesystem::path autosave_folder();

/// Theme, scale (over the monitor's), colour map, panels, how plots are laid, and the window's place as JSON.
[[nodiscard]] std::string settings_text(const ViewState& state);
/// Takes over valid settings; all others keep their values. Returns false when the text is no JSON object.
bool apply_settings(const std::string& text, ViewState& state);

/// Recent files as JSON, and back; false when the text is no JSON array.
[[nodiscard]] std::string recent_text(const ViewState& state);
bool apply_recent(const std::string& text, ViewState& state);
/// Reads and writes the recent files, with the errors of load_settings and save_settings. Files that other windows have added meanwhile
/// stay, behind this one's.
void load_recent(const std::filesystem::path& path, ViewState& state);

/// Reads the file if there is one. Never throws: a broken file gives a message in the log.
void load_settings(const std::filesystem::path& path, ViewState& state);
/// Writes the settings, all or nothing. Returns a sentence when that failed.
std::string save_settings(const std::filesystem::path& path, const ViewState& state);

class SettingsKeeper {
 public:
  /// Seconds for which settings must be unchanged before they are written, so that not every width of a dragged panel is.
  static constexpr double kStill = 0.3;

  /// Reads both files. Empty paths: neither read nor written.
  void begin(std::filesystem::path settings, std::filesystem::path recent, ViewState& state);
  /// Writes changes; to be called once a frame, at `now` (seconds). Failures are messages in the log. Returns the seconds after which it
  /// must be called again; infinity: when something changes.
  double look(ViewState& state, double now);
  /// Writes everything that is not yet written. Returns sentences about failures.
  [[nodiscard]] std::vector<std::string> write(const ViewState& state);

 private:
  std::filesystem::path settings_, recent_;
  std::string written_, seen_;  // texts of the settings
  std::vector<std::string> written_recent_;
  double since_ = 0.0;
  std::string said_;
};

}  // namespace dmoscope::ui
