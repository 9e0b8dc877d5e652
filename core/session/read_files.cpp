#include "core/session/read_files.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/words.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope {
namespace {

/// Commands whose first word that is no option names a file; the window's are among them.
constexpr std::array<std::string_view, 2> kReading{"open", "open-state"};
constexpr std::array<std::string_view, 8> kWriting{"export",     "stats",     "elements",    "save-state",
                                                   "screenshot", "plot-save", "save-script", "export-trace"};
constexpr std::string_view kSaveSession = "save-session", kOpenSession = "open-session";

template <class Names>
bool among(const Names& names, std::string_view command) {
  return std::ranges::find(names, command) != names.end();
}

struct FileLine {
  std::string command, file;
};

/// Empty for a line that names no file, and for one that the script will end at.
FileLine file_line(std::string_view line) {
  try {
    const std::vector<std::string> words = split_words(line);
    for (std::size_t i = 1; i < words.size(); ++i)
      if (!words[i].starts_with("--")) return {words[0], words[i]};
  } catch (const UsageError&) {
  }
  return {};
}

}  // namespace

void ReadFiles::add(const std::filesystem::path& path) {
  const auto same = [&path](const std::filesystem::path& known) { return same_file(known, path); };
  if (std::ranges::none_of(files_, same)) files_.push_back(std::filesystem::absolute(path));
}

void ReadFiles::add(const Mesh& mesh, const std::filesystem::path& path) {
  add(path);
  if (!mesh.source) return;
  add(mesh.source->path());
  if (mesh.source->companion() != nullptr) add(mesh.source->companion()->path());
}

void ReadFiles::require_another(const std::filesystem::path& target, std::string_view command) const {
  for (const std::filesystem::path& file : files_)
    if (same_file(target, file))
      throw UsageError(fmt::format("{} {}: this is a mesh that was opened here, which it would overwrite: write to another file", command,
                                   target.string()));
}

Overwriting first_overwriting(const std::filesystem::path& script, std::span<const std::string> lines) {
  std::vector<std::pair<std::filesystem::path, std::size_t>> read{{script, 0}};
  std::vector<std::filesystem::path> sessions;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const FileLine line = file_line(lines[i]);
    const bool saves_session = line.command == "save-state" || line.command == kSaveSession;
    if (among(kReading, line.command) || line.command == kOpenSession) {
      // A session may be saved over what it was opened from; a mesh may not.
      if (line.command == "open")
        read.emplace_back(line.file, i + 1);
      else
        sessions.emplace_back(line.file);
    }
    if (!among(kWriting, line.command) && !saves_session) continue;
    for (const auto& [file, where] : read)
      if (same_file(file, line.file))
        return {i + 1, fmt::format("{} {} would overwrite {}", line.command, line.file,
                                   where == 0 ? std::string("this script") : fmt::format("the mesh that line {} opens", where))};
    if (!saves_session && std::ranges::any_of(sessions, [&](const auto& file) { return same_file(file, line.file); }))
      return {i + 1, fmt::format("{} {} would overwrite a session that is opened", line.command, line.file)};
  }
  return {};
}

}  // namespace dmoscope
