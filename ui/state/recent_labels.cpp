#include "ui/state/recent_labels.h"

#include <algorithm>
#include <filesystem>

namespace dmoscope::ui {
namespace {

/// The last `count` folders of a path.
std::string folders_of(const std::filesystem::path& file, std::size_t count) {
  std::filesystem::path folders;
  std::filesystem::path at = file.parent_path();
  for (std::size_t k = 0; k < count && at.has_filename(); ++k, at = at.parent_path())
    folders = folders.empty() ? at.filename() : at.filename() / folders;
  return at.has_filename() ? folders.string() : (at / folders).string();
}

}  // namespace

std::vector<std::string> short_names(std::span<const std::string> files) {
  std::vector<std::string> names;
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    const auto rival = [&](const std::string& other) {
      return other != file && std::filesystem::path(other).filename() == path.filename();
    };
    std::string name = path.filename().string();
    if (std::ranges::any_of(files, rival)) {
      const auto depth = static_cast<std::size_t>(std::distance(path.begin(), path.end()));
      std::size_t count = 1;
      const auto alike = [&](const std::string& other) { return rival(other) && folders_of(other, count) == folders_of(path, count); };
      while (count < depth && std::ranges::any_of(files, alike)) ++count;
      name += "   " + folders_of(path, count);
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace dmoscope::ui
