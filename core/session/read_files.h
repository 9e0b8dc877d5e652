#pragma once
// Files that a session was read from, which it must not overwrite.

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope {

class ReadFiles {
 public:
  /// Adds all files of a mesh, see mesh_files(). An empty path is none.
  void add(const std::filesystem::path& path);
  /// Throws UsageError if `target`, which `command` ("stats") would write, is one of them, also through links, or if a mesh written there
  /// would replace one. Saved sessions and `reload` need these files unchanged.
  void require_another(const std::filesystem::path& target, std::string_view command) const;
  /// Throws UsageError if a line of commands would overwrite one of them.
  void require_another(std::string_view line) const;

 private:
  std::set<std::filesystem::path> files_;
};

/// A line of a script that would overwrite a file which an earlier one reads, or the script itself.
struct Overwriting {
  std::size_t line = 0;  // line number from 1; 0: none
  std::string what;
};
[[nodiscard]] Overwriting first_overwriting(const std::filesystem::path& script, std::span<const std::string> lines);

// Copies of files that are about to be overwritten.

/// Name for a copy of a file: "east.orig.14", then "east.orig2.14", ...; the format's extension stays, so that it can be opened.
[[nodiscard]] std::filesystem::path original_name(const std::filesystem::path& file, unsigned number);

/// Copies each of these files beside itself, all under the first number that is free for all of them, so that no older copy is overwritten.
/// Missing files are skipped. Returns the copies' names, in the order of the files; empty for a missing one. Throws OutputError, and then
/// leaves none of the copies.
[[nodiscard]] std::vector<std::filesystem::path> keep_originals(std::span<const std::filesystem::path> files);

}  // namespace dmoscope
