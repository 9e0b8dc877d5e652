#include "ui/settings.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/io/mesh_io.h"

namespace dmoscope::ui {
namespace {

using nlohmann::json;

constexpr const char* kThemeNames[] = {"dark", "light", "contrast"};

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

}  // namespace

std::filesystem::path settings_path() {
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config != nullptr && *config != '\0') {
    return std::filesystem::path(config) / "dmoscope" / "settings.json";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".config" / "dmoscope" / "settings.json";
  }
  return {};
}

std::string settings_text(const ViewState& state) {
  const Panels& panels = state.panels;
  json out = {{"theme", kThemeNames[static_cast<int>(state.theme)]},
              {"scale", state.scale},
              {"colormap", render::name(state.colour_map)},
              {"wireframe", state.wireframe},
              {"recent", state.recent_files},
              {"panels",
               {{"left", panels.left},
                {"right", panels.right},
                {"bottom", panels.bottom},
                {"left_width", panels.left_width},
                {"right_width", panels.right_width},
                {"bottom_height", panels.bottom_height}}}};
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

bool apply_settings(const std::string& text, ViewState& state) {
  const json in = json::parse(text, nullptr, false);
  if (!in.is_object()) return false;
  if (const auto at = in.find("theme"); at != in.end() && at->is_string()) {
    for (int k = 0; k < 3; ++k) {
      if (at->get<std::string>() == kThemeNames[k]) state.theme = static_cast<Theme>(k);
    }
  }
  take(in, "scale", state.scale, 0.5, 4.0);
  take(in, "wireframe", state.wireframe);
  if (const auto at = in.find("colormap"); at != in.end() && at->is_string()) {
    for (const auto& map : render::colour_map_table()) {
      if (map.name == at->get<std::string>()) state.colour_map = map.map;
    }
  }
  if (const auto at = in.find("recent"); at != in.end() && at->is_array()) {
    state.recent_files.clear();
    for (const json& file : *at) {
      if (file.is_string() && state.recent_files.size() < 10) state.recent_files.push_back(file.get<std::string>());
    }
  }
  if (const auto at = in.find("panels"); at != in.end() && at->is_object()) {
    take(*at, "left", state.panels.left);
    take(*at, "right", state.panels.right);
    take(*at, "bottom", state.panels.bottom);
    take(*at, "left_width", state.panels.left_width, 8.0, 60.0);
    take(*at, "right_width", state.panels.right_width, 8.0, 60.0);
    take(*at, "bottom_height", state.panels.bottom_height, 6.0, 60.0);
  }
  return true;
}

void load_settings(const std::filesystem::path& path, ViewState& state) {
  if (path.empty()) return;
  std::ifstream file(path, std::ios::binary);
  if (!file) return;
  std::ostringstream text;
  text << file.rdbuf();
  if (!apply_settings(text.str(), state)) {
    add_message(state, {Message::Kind::Warning, "settings ignored, not a JSON object: " + path.string(), 0});
  }
}

std::string save_settings(const std::filesystem::path& path, const ViewState& state) {
  if (path.empty()) return {};
  try {
    std::filesystem::create_directories(path.parent_path());
    write_file_atomically(path, settings_text(state));
    return {};
  } catch (const std::exception& error) {
    return std::string("settings not saved: ") + error.what();
  }
}

}  // namespace dmoscope::ui
