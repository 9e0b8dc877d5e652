#pragma once
// The files that a session was read from: nothing that it writes may take their place.

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace dmoscope {

class ReadFiles {
 public:
  /// All files of a mesh, see mesh_files(). An empty path is none.
  void add(const std::filesystem::path& path);
  /// Throws UsageError when `target`, which `command` ("stats") would write, is one of them, also through links, or a mesh that is written
  /// there would replace one. Sessions that are saved and `reload` need these files as they were.
  void require_another(const std::filesystem::path& target, std::string_view command) const;
  /// The same of all files that a line of commands writes.
  void require_another(std::string_view line) const;

 private:
  std::set<std::filesystem::path> files_;
};

/// A line of a script that would overwrite what an earlier one reads, or the script itself.
struct Overwriting {
  std::size_t line = 0;  // from 1; 0: none
  std::string what;
};
[[nodiscard]] Overwriting first_overwriting(const std::filesystem::path& script, std::span<const std::string> lines);

}  // namespace dmoscope
