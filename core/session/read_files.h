#pragma once
// The files that a session was read from: nothing that it writes may take their place.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

class ReadFiles {
 public:
  /// A mesh's own file, and its companion where the format has two.
  void add(const Mesh& mesh, const std::filesystem::path& path);
  void add(const std::filesystem::path& path);
  /// Throws UsageError when `target`, which `command` ("stats") would write, is one of them, also through links. Sessions that are saved
  /// and `reload` need these files as they were.
  void require_another(const std::filesystem::path& target, std::string_view command) const;

 private:
  std::vector<std::filesystem::path> files_;  // no two are the same
};

/// A line of a script that would overwrite what an earlier one reads, or the script itself.
struct Overwriting {
  std::size_t line = 0;  // from 1; 0: none
  std::string what;
};
[[nodiscard]] Overwriting first_overwriting(const std::filesystem::path& script, std::span<const std::string> lines);

}  // namespace dmoscope
