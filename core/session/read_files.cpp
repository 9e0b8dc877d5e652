#include "core/session/read_files.h"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/words.h"
#include "core/io/mesh_io.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope {

namespace {

/// Commands whose arguments, without the options, name files; those of the window are among them. A session may be saved over the file that
/// it was opened from; a mesh may not.
constexpr std::array<std::string_view, 3> kReading{"open", "open-beside", "surface"};
constexpr std::array<std::string_view, 2> kReadingSessions{"open-state", "open-session"}, kSavingSessions{"save-state", "save-session"};
constexpr std::array<std::string_view, 8> kWriting{"export",    "stats",       "elements",     "screenshot",
                                                   "plot-save", "save-script", "export-trace", "save-report"};

template <class Names>
bool among(const Names& names, std::string_view command) {
  return std::ranges::find(names, command) != names.end();
}

struct FileLine {
  std::string command;
  std::vector<std::string> files;
};

/// The command of a line and the files that it names; none for a line at which the script will fail.
FileLine file_line(std::string_view line) {
  try {
    std::vector<std::string> words = split_words(line);
    if (words.empty()) return {};
    FileLine found{std::move(words[0]), {}};
    for (std::size_t i = 1; i < words.size(); ++i)
      if (!words[i].starts_with("--")) found.files.push_back(std::move(words[i]));
    if (!among(kWriting, found.command)) found.files.resize(std::min<std::size_t>(found.files.size(), 1));  // the others may be a view
    return found;
  } catch (const UsageError&) {
    return {};
  }
}

}  // namespace

void ReadFiles::add(const std::filesystem::path& path) {
  if (path.empty()) return;
  for (const std::filesystem::path& file : mesh_files(path)) files_.insert(std::filesystem::absolute(file));
}

void ReadFiles::require_another(const std::filesystem::path& target, std::string_view command) const {
  for (const std::filesystem::path& file : files_)
    if (may_write(target, file))
      throw UsageError(fmt::format("{} {}: {} that was opened here, which it would overwrite: write to another file", command,
                                   target.string(), same_file(target, file) ? "this is a mesh" : file.string() + " is of a mesh"));
}

void ReadFiles::require_another(std::string_view line) const {
  const FileLine written = file_line(line);
  if (!among(kWriting, written.command)) return;
  for (const std::string& file : written.files) require_another(file, written.command);
}

Overwriting first_overwriting(const std::filesystem::path& script, std::span<const std::string> lines) {
  std::vector<std::pair<std::filesystem::path, std::size_t>> read{{script, 0}};
  std::vector<std::filesystem::path> sessions;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const FileLine line = file_line(lines[i]);
    const bool saves_session = among(kSavingSessions, line.command);
    for (const std::string& file : line.files) {
      if (among(kReading, line.command)) read.emplace_back(file, i + 1);
      if (among(kReadingSessions, line.command)) sessions.emplace_back(file);
      if (!among(kWriting, line.command) && !saves_session) continue;
      for (const auto& [mesh, where] : read)
        if (!replaced_file(file, mesh).empty())
          return {i + 1, fmt::format("{} {} would overwrite {}", line.command, file,
                                     where == 0 ? std::string("this script") : fmt::format("the mesh that line {} opens", where))};
      if (!saves_session && std::ranges::any_of(sessions, [&](const auto& session) { return same_file(session, file); }))
        return {i + 1, fmt::format("{} {} would overwrite a session that is opened", line.command, file)};
    }
  }
  return {};
}

namespace fs = std::filesystem;

fs::path original_name(const fs::path& file, unsigned number) {
  const std::string tag = number == 1 ? ".orig" : fmt::format(".orig{}", number);
  fs::path stem = file.stem(), ending = file.extension();
  if (ending == ".gz") {  // file name like "a.vtk.gz"
    ending = stem.extension().string() + ending.string();
    stem = stem.stem();
  }
  return file.parent_path() / (stem.string() + tag + ending.string());
}

std::vector<fs::path> keep_originals(std::span<const fs::path> files) {
  std::error_code error;
  const auto taken = [&](unsigned number) {
    return std::ranges::any_of(files,
                               [&](const fs::path& file) { return fs::exists(fs::symlink_status(original_name(file, number), error)); });
  };
  unsigned number = 1;
  while (taken(number)) ++number;
  std::vector<fs::path> copies;
  for (const fs::path& file : files) {
    copies.emplace_back();
    if (!fs::exists(file, error)) continue;
    const fs::path copy = original_name(file, number);
    if (fs::copy_file(file, copy, fs::copy_options::none, error)) {
      copies.back() = copy;
      continue;
    }
    std::error_code ignored;
    if (error != std::errc::file_exists) fs::remove(copy, ignored);  // removes the incomplete copy
    for (const fs::path& other : copies) fs::remove(other, ignored);
    throw OutputError(copy.string(), fmt::format("no copy can be kept of what is written over: {}", error.message()));
  }
  return copies;
}

}  // namespace dmoscope
