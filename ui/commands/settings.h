#pragma once
// What the window remembers between starts.

#include <filesystem>
#include <string>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// $XDG_CONFIG_HOME/dmoscope/settings.json, else ~/.config/dmoscope/settings.json; empty when neither is known.
[[nodiscard]] std::filesystem::path settings_path();

/// $XDG_STATE_HOME/dmoscope/recent.json, else ~/.local/state/dmoscope/recent.json; empty when neither is known.
[[nodiscard]] std::filesystem::path recent_path();

/// Folder of what windows save by themselves: $XDG_STATE_HOME/dmoscope/autosave, else below ~/.local/state; empty when neither is known.
[[nodiscard]] std::filesystem::path autosave_folder();

/// Theme, scale (over the monitor's), colour map, panels, how plots are laid, and the window's place as JSON.
[[nodiscard]] std::string settings_text(const ViewState& state);
/// Takes over what is there and makes sense; anything else keeps its value. Returns false when the text is no JSON object.
bool apply_settings(const std::string& text, ViewState& state);

/// Recent files as JSON, and back; false when the text is no JSON array.
[[nodiscard]] std::string recent_text(const ViewState& state);
bool apply_recent(const std::string& text, ViewState& state);
/// As load_settings and save_settings. What other windows have put there meanwhile stays, behind this one's.
void load_recent(const std::filesystem::path& path, ViewState& state);
std::string save_recent(const std::filesystem::path& path, const ViewState& state);

/// Reads the file if there is one. Never throws: a broken file gives a sentence in the log.
void load_settings(const std::filesystem::path& path, ViewState& state);
/// Writes it, all or nothing. Returns a sentence when that failed.
std::string save_settings(const std::filesystem::path& path, const ViewState& state);

}  // namespace dmoscope::ui
