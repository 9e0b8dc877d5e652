#include "ui/toolkit/file_browser.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/words.h"
#include "core/commands/commands.h"
#include "core/io/mesh_io.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

BeingRead of_file(const std::filesystem::path& path) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(path, unknown);
  const std::filesystem::path folder = std::filesystem::absolute(path, unknown).parent_path();
  return {path.filename().string(), unknown ? folder.string() : fmt::format("{} in {}", byte_size(bytes), folder.string())};
}

/// Whether a name has the extension of a format that can be read.
bool is_mesh_name(std::string_view name) {
  const std::string small = lower_case(name);
  for (const FormatInfo& format : format_table()) {
    std::string_view extensions = format.extensions;
    while (!extensions.empty()) {
      const std::size_t blank = std::min(extensions.find(' '), extensions.size());
      const std::string_view extension = extensions.substr(0, blank);
      if (!extension.empty() && small.size() > extension.size() && small.ends_with(extension)) return true;
      extensions.remove_prefix(std::min(blank + 1, extensions.size()));
    }
  }
  return false;
}

bool is_session_name(std::string_view name) {
  return name.size() > kSessionExtension.size() && lower_case(name).ends_with(kSessionExtension);
}

/// The command that opens a mesh beside those that are open; a session in their place.
std::string open_beside_command(const std::string& file) {
  return is_session_name(file) ? open_command(file) : "open-beside " + quote_word(file);
}

}  // namespace

std::string open_command(const std::string& file) {
  return fmt::format("{} {}", is_session_name(file) ? "open-session" : "open", quote_word(file));
}

std::vector<std::string> commands_to_open(OpenFor open_for, const std::vector<std::filesystem::path>& files) {
  if (open_for == OpenFor::Alone) return open_commands(files);
  std::vector<std::string> commands;
  for (const std::filesystem::path& file : files)
    commands.push_back(open_for == OpenFor::Surface ? "surface " + quote_word(file.string()) : open_beside_command(file.string()));
  return commands;
}

const char* title_to_open(OpenFor open_for) {
  return open_for == OpenFor::Beside    ? "Open a mesh beside"
         : open_for == OpenFor::Surface ? "Slide on the surface of a mesh"
                                        : "Open a mesh";
}

std::vector<std::string> open_commands(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> commands;
  for (const std::filesystem::path& file : files) {
    const std::string name = file.string();
    commands.push_back(commands.empty() ? open_command(name) : open_beside_command(name));
  }
  return commands;
}

std::vector<FolderEntry> list_folder(const std::filesystem::path& folder, bool all, std::string& error) {
  std::vector<FolderEntry> entries;
  error.clear();
  std::error_code code;
  std::filesystem::directory_iterator at(folder, std::filesystem::directory_options::skip_permission_denied, code);
  for (const std::filesystem::directory_iterator end; !code && at != end; at.increment(code)) {
    FolderEntry entry{at->path().filename().string(), false, 0};
    if (entry.name.empty() || entry.name.front() == '.') continue;
    std::error_code ignored;
    entry.folder = at->is_directory(ignored);
    if (!entry.folder && !all && !is_mesh_name(entry.name) && !is_session_name(entry.name)) continue;
    if (!entry.folder) entry.bytes = at->file_size(ignored);
    if (ignored) entry.bytes = 0;
    entries.push_back(std::move(entry));
  }
  if (code) error = folder.string() + ": " + code.message();
  std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
    if (a.folder != b.folder) return a.folder;
    const std::string x = lower_case(a.name), y = lower_case(b.name);
    return x != y ? x < y : a.name < b.name;
  });
  return entries;
}

std::string byte_size(std::uintmax_t bytes) {
  const double value = static_cast<double>(bytes);
  if (value >= 1e9) return fmt::format("{:.1f} GB", value / 1e9);
  if (value >= 1e6) return fmt::format("{:.1f} MB", value / 1e6);
  if (value >= 1e3) return fmt::format("{:.1f} kB", value / 1e3);
  return fmt::format("{} B", bytes);
}

std::string parent_folder(const std::string& folder) {
  std::filesystem::path path(folder);
  if (!path.has_filename()) path = path.parent_path();  // the path ended with a slash
  return path.has_parent_path() ? path.parent_path().string() : folder;
}

const std::vector<RecentFile>& RecentFiles::list(const std::vector<std::string>& files, double now) {
  const bool same = std::ranges::equal(files, files_, {}, {}, &RecentFile::path);
  if (same && now - asked_ < kSeconds) return files_;
  asked_ = now;
  files_.clear();
  for (const std::string& file : files) {
    std::error_code ignored;
    files_.push_back({file, !std::filesystem::exists(file, ignored)});
  }
  return files_;
}

std::optional<BeingRead> being_read(std::string_view command) {
  try {
    const std::vector<std::string> words = split_words(command);
    if (words.size() < 2) return std::nullopt;
    if (words[0] == "open" || words[0] == "open-state") return of_file(words[1]);
    if (words[0] == "generate") return BeingRead{"sample " + words[1], {}};
  } catch (const UsageError&) {  // a quote is not closed: the session reports it
  }
  return std::nullopt;
}

}  // namespace dmoscope::ui
