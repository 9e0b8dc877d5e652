#include "ui/commands/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

using nlohmann::json;

void take(const json& from, const char* name, bool& value) {
  const auto at = from.find(name);
  if (at != from.end() && at->is_boolean()) value = at->get<bool>();
}

void take(const json& from, const char* name, double& value, double least, double most) {
  const auto at = from.find(name);
  if (at == from.end() || !at->is_number()) return;
  const double read = at->get<double>();
  if (read >= least && read <= most) value = read;
}

/// Keeps the second number of a range greater than the first; otherwise both stay as they were.
void keep_ranges(const ViewState& before, ViewState& next) {
  if (!(next.range_low < next.range_high)) {
    next.range_low = before.range_low;
    next.range_high = before.range_high;
  }
  if (!(next.range_low_percent < next.range_high_percent)) {
    next.range_low_percent = before.range_low_percent;
    next.range_high_percent = before.range_high_percent;
  }
}

constexpr int kLayout = 3;  // layouts: 1, which was not written, wide side panels; 2, narrower ones; 3, one column

/// Replaces sizes of panels that are old defaults: settings have always held sizes, also when nobody had chosen them.
void forget_old_defaults(Panels& panels, int layout) {
  const auto forget = [&panels](double Panels::*size, double usual) {
    if (panels.*size == usual) panels.*size = Panels{}.*size;
  };
  forget(&Panels::left_width, layout == 1 ? 17.0 : 14.0);
  forget(&Panels::right_width, layout == 1 ? 22.0 : 15.6);
  forget(&Panels::bottom_height, 15.0);
  forget(&Panels::runs_height, 6.2);
}

/// Path of one of the program's files by the XDG rules: in the folder `variable`, else in `fallback` in the home.
std::filesystem::path xdg_path(const char* variable, const char* fallback, const char* name) {
  if (const char* folder = std::getenv(variable); folder != nullptr && *folder != '\0') {
    return std::filesystem::path(folder) / "dmoscope" / name;
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / fallback / "dmoscope" / name;
  }
  return {};
}

constexpr std::size_t kMostRecent = 10;

/// Takes only whole paths: older versions wrote relative ones, whose folder is not known.
void take_recent(const json& files, std::vector<std::string>& recent) {
  for (const json& file : files) {
    if (!file.is_string() || recent.size() >= kMostRecent) continue;
    std::string path = file.get<std::string>();
    if (path.starts_with('/') && std::ranges::find(recent, path) == recent.end()) recent.push_back(std::move(path));
  }
}

void take_place(const json& in, WindowPlace& place) {
  const auto at = in.find("window");
  if (at == in.end() || !at->is_object()) return;
  constexpr double kLeast = 200, kMost = 32768;
  double width = place.width, height = place.height;
  take(*at, "width", width, kLeast, kMost);
  take(*at, "height", height, kLeast, kMost);
  take(*at, "maximised", place.maximised);
  place.width = static_cast<int>(width);
  place.height = static_cast<int>(height);
}

/// The file's text; none if there is no such file.
std::optional<std::string> read_text(const std::filesystem::path& path) {
  constexpr std::size_t kMost = std::size_t{1} << 24U;
  try {
    return read_small_text(path, kMost);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string save_text(const std::filesystem::path& path, const std::string& text, const char* what) {
  if (path.empty()) return {};
  try {
    std::filesystem::create_directories(path.parent_path());
    write_file_atomically(path, text);
    return {};
  } catch (const std::exception& error) {
    return fmt::format("{} not saved: {}", what, error.what());
  }
}

std::string save_recent(const std::filesystem::path& path, const ViewState& state) {
  ViewState merged;
  merged.recent_files = state.recent_files;
  if (const auto text = read_text(path)) {
    const json there = json::parse(*text, nullptr, false);
    if (there.is_array()) take_recent(there, merged.recent_files);
  }
  return save_text(path, recent_text(merged), "recent files");
}

}  // namespace

std::filesystem::path settings_path() { return xdg_path("XDG_CONFIG_HOME", ".config", "settings.json"); }

std::filesystem::path recent_path() { return xdg_path("XDG_STATE_HOME", ".local/state", "recent.json"); }

std::filesystem::path autosave_folder() { return xdg_path("XDG_STATE_HOME", ".local/state", "autosave"); }

std::string settings_text(const ViewState& state) {
  json out = {{"scale", state.scale / state.monitor_scale}, {"panels", {{"layout", kLayout}}}};
  if (const WindowPlace& place = state.place; place.width > 0)
    out["window"] = {{"width", place.width}, {"height", place.height}, {"maximised", place.maximised}};
  for (const ViewOption& option : view_options())
    if (!option.kept.setting.empty()) out[json::json_pointer(std::string(option.kept.setting))] = option.saved(state);
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

bool apply_settings(const std::string& text, ViewState& state) {
  const json in = json::parse(text, nullptr, false);
  if (!in.is_object()) return false;
  ViewState next = state;
  for (const ViewOption& option : view_options()) {
    const json::json_pointer setting{std::string(option.kept.setting)};
    if (!option.kept.setting.empty() && in.contains(setting)) (void)option.take(in[setting], next);
  }
  keep_ranges(state, next);
  state = std::move(next);
  double scale = state.scale / state.monitor_scale;
  take(in, "scale", scale, 0.125, 4.0);
  state.scale = std::clamp(scale * state.monitor_scale, 0.5, 4.0);
  if (const auto at = in.find("recent"); at != in.end() && at->is_array()) {  // written by older versions
    state.recent_files.clear();
    take_recent(*at, state.recent_files);
  }
  take_place(in, state.place);
  if (const auto at = in.find("panels"); at != in.end() && at->is_object()) {
    double layout = 1;
    take(*at, "layout", layout, 1, kLayout);
    if (layout < kLayout) forget_old_defaults(state.panels, static_cast<int>(layout));
  }
  return true;
}

void load_settings(const std::filesystem::path& path, ViewState& state) {
  const auto text = read_text(path);
  if (text && !apply_settings(*text, state))
    add_message(state, {Message::Kind::Warning, "settings ignored, not a JSON object: " + path.string(), 0});
}

std::string save_settings(const std::filesystem::path& path, const ViewState& state) {
  return save_text(path, settings_text(state), "settings");
}

std::string recent_text(const ViewState& state) {
  return json(state.recent_files).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

bool apply_recent(const std::string& text, ViewState& state) {
  const json in = json::parse(text, nullptr, false);
  if (!in.is_array()) return false;
  state.recent_files.clear();
  take_recent(in, state.recent_files);
  return true;
}

void load_recent(const std::filesystem::path& path, ViewState& state) {
  const auto text = read_text(path);
  if (text && !apply_recent(*text, state))
    add_message(state, {Message::Kind::Warning, "recent files ignored, not a JSON array: " + path.string(), 0});
}

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
