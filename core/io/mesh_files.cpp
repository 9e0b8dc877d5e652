// Files of a mesh on disk, and which of them may be replaced.

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/format_choice.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

/// Further files of a mesh that is read from more than one.
std::vector<std::filesystem::path> further_files(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  Progress unwatched;
  const IoContext context(unwatched);
  std::string head(65536, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  const FormatHandler* named = by_extension(mesh_extension(path));
  const auto may_have = [&](const FormatHandler* handler) {
    return handler->further != nullptr && (handler == named || is_certain(*handler, head));
  };
  if (std::ranges::none_of(format_handlers(), may_have)) return {};
  try {
    std::size_t size = 0;
    const SourceFile source(path, read_unpacked(path, context, size));
    const FormatHandler& handler = format_of(path, source.bytes());
    if (handler.further != nullptr) return handler.further(source, context);
  } catch (const std::exception&) {  // ignored: reading the mesh reports it
  }
  return {};
}

/// The real name of a file, with all links followed.
std::filesystem::path real_path(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
}

}  // namespace

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path) {
  const FormatHandler* named = by_extension(mesh_extension(path));
  const std::filesystem::path main = main_path(path, named);
  std::vector<std::filesystem::path> files{path};
  if (main != path) files.push_back(main);
  if (named != nullptr && named->companion != nullptr && main == path) files.push_back(companion_path(main, *named->companion));
  for (std::filesystem::path& file : further_files(main)) files.push_back(std::move(file));
  return files;
}

bool same_mesh(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto main = [](const std::filesystem::path& path) { return main_path(path, by_extension(mesh_extension(path))); };
  return same_file(main(a), main(b));
}

bool may_write(const std::filesystem::path& target, const std::filesystem::path& file) {
  if (same_file(target, file)) return true;
  const FormatHandler* handler = by_extension(mesh_extension(target));
  if (handler == nullptr) return false;
  const std::filesystem::path main = main_path(target, handler);
  if (handler->companion != nullptr) return same_file(main, file) || same_file(companion_path(main, *handler->companion), file);
  if (handler->writes_beside == nullptr) return false;
  return same_file(main.parent_path() / file.filename(), file) && handler->writes_beside(main, file);
}

std::filesystem::path replaced_file(const std::filesystem::path& target, const std::filesystem::path& read) {
  if (target.empty() || read.empty()) return {};
  const std::vector<std::filesystem::path> files = mesh_files(read);
  for (const auto is_hit : {same_file, may_write})
    for (const std::filesystem::path& file : files)
      if (is_hit(target, file)) return file;
  return {};
}

FormerMesh::FormerMesh(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  if (!std::filesystem::exists(path_, error)) return;
  for (const std::filesystem::path& file : mesh_files(path_)) files_.insert(real_path(file));
}

void FormerMesh::require_own(const std::filesystem::path& beside) const {
  std::error_code error;
  if (same_file(beside, path_) || !std::filesystem::exists(beside, error) || files_.contains(real_path(beside))) return;
  throw OutputError(beside.string(),
                    fmt::format("it is no part of {}, with which it would be replaced: name the output otherwise, or move it",
                                path_.filename().string()));
}

void FormerMesh::settle(Notes& notes) const {
  std::set<std::filesystem::path> present;
  std::error_code error;
  for (const std::filesystem::path& file : mesh_files(path_)) present.insert(real_path(file));
  std::vector<std::string> removed, left;
  for (const std::filesystem::path& file : files_) {
    if (!std::filesystem::exists(file, error) || present.contains(file)) continue;
    // Removes only pieces under a name that the writer gives, which belonged to that file alone; others may serve other files, too.
    const bool ours = equal_ignoring_case(file.extension().string(), ".vtu") && may_write(path_, file);
    (ours && std::filesystem::remove(file, error) ? removed : left).push_back(file.filename().string());
  }
  const auto tell = [&](const std::vector<std::string>& names, std::string_view what) {
    if (names.empty()) return;
    const std::string more = names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : std::string();
    notes.push_back(fmt::format("{}: {}{}, of the mesh that was replaced.", what, names.front(), more));
  };
  tell(removed, "Removed");
  tell(left, "Left");
}

}  // namespace dmoscope
