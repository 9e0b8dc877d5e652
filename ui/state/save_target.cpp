#include "ui/state/save_target.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "core/io/mesh_io.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

namespace fs = std::filesystem;

std::string home() {
  const char* folder = std::getenv("HOME");
  return folder == nullptr ? std::string() : folder;
}

fs::path whole(const fs::path& path) {
  std::error_code ignored;
  fs::path out = fs::absolute(path, ignored).lexically_normal();
  if (!out.has_filename() && out.has_parent_path() && out != out.root_path()) out = out.parent_path();
  return out;
}

bool has_known_ending(const fs::path& path, const SaveEndings& endings) {
  const std::string ending = lower_case(path.extension().string());
  if (std::ranges::find(endings.endings, ending) != endings.endings.end()) return true;
  return endings.meshes && format_by_extension(mesh_extension(path)) != nullptr;
}

std::string refusal_of_ending(const fs::path& path, const SaveEndings& endings) {
  std::vector<std::string> known = endings.endings;
  if (endings.meshes) {
    for (const FormatInfo& format : format_table()) {
      const std::string extensions(format.extensions);
      known.push_back(extensions.substr(0, extensions.find(' ')));
    }
  }
  return fmt::format("{} is not written as {}; it can be {}", endings.what, path.extension().string(), fmt::join(known, " "));
}

std::string refusal(const fs::path& path, const SaveEndings& endings) {
  std::error_code ignored;
  if (path.empty()) return "a file name is missing";
  if (fs::is_directory(path, ignored)) return path.string() + " is a folder: a file name is missing";
  const fs::path folder = path.parent_path();
  if (!fs::is_directory(folder, ignored)) return folder.string() + ": there is no such folder";
  if (!has_known_ending(path, endings)) return refusal_of_ending(path, endings);
  if (::access(folder.c_str(), W_OK) != 0) return folder.string() + ": nothing can be written into this folder";
  return {};
}

}  // namespace

fs::path SaveTarget::path() const {
  if (name.empty()) return {};
  if (name.starts_with("~/") && !home().empty()) return whole(fs::path(home()) / name.substr(2));
  return whole(fs::path(folder) / name);
}

void SaveTarget::set_path(const fs::path& path) {
  const fs::path taken = whole(path);
  folder = taken.parent_path().string();
  name = taken.filename().string();
  asked.clear();
  trouble.clear();
}

SaveVerdict judge(SaveTarget& target, const SaveEndings& endings) {
  target.trouble.clear();
  std::error_code ignored;
  fs::path path = target.path();
  const bool bare = !path.empty() && !path.has_extension() && !fs::is_directory(path, ignored) && target.name.back() != '/';
  if (bare && !endings.endings.empty()) {
    target.name += endings.endings.front();
    path = target.path();
  }
  target.trouble = refusal(path, endings);
  if (!target.trouble.empty()) {
    target.asked.clear();
    return SaveVerdict::Refused;
  }
  if (fs::exists(path, ignored) && target.replaced != path.string()) {
    target.asked = path.string();
    return SaveVerdict::Asks;
  }
  return SaveVerdict::Ready;
}

std::vector<Place> places(const fs::path& mesh, std::span<const std::string> recent_files) {
  std::vector<Place> out;
  const auto add = [&out](const std::string& title, const fs::path& folder) {
    std::error_code ignored;
    if (folder.empty() || !fs::is_directory(folder, ignored)) return;
    const std::string path = whole(folder).string();
    if (std::ranges::find(out, path, &Place::folder) == out.end()) out.push_back({title, path});
  };
  std::error_code ignored;
  if (!mesh.empty()) add("Beside the mesh", whole(mesh).parent_path());
  add("Home", home());
  add("Working directory", fs::current_path(ignored));
  for (const std::string& file : recent_files) {
    const fs::path folder = whole(file).parent_path();
    add(folder.filename().string(), folder);
  }
  return out;
}

std::string first_folder(const fs::path& mesh) {
  std::error_code ignored;
  if (!mesh.empty()) {
    const fs::path folder = whole(mesh).parent_path();
    if (fs::is_directory(folder, ignored)) return folder.string();
  }
  return fs::current_path(ignored).string();
}

}  // namespace dmoscope::ui
