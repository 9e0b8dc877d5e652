#pragma once
// Files as an independent program reads them: Debian's python3-meshio, where it is installed.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dmoscope::test {

/// What meshio found in a file: signed volumes (areas, with z upwards) of all cells of a kind, added up, with the corners as
/// meshio gives them; and how many points.
struct MeshioFile {
  std::size_t points = 0;
  std::map<std::string, double> sizes;         // by meshio's name for the kind
  std::map<std::string, std::size_t> numbers;  // of cells, by kind
};

/// Nothing where there is no meshio. Runs Python once for all files. A file that meshio refuses has no points.
[[nodiscard]] std::optional<std::vector<MeshioFile>> read_by_meshio(const std::vector<std::filesystem::path>& files);

}  // namespace dmoscope::test
