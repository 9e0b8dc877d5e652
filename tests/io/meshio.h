#pragma once
// Files read by an independent program: Debian's python3-meshio, if it is installed.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dmoscope::test {

/// Findings of meshio in a file: signed volumes (areas, with z upwards) of all cells of a kind, added up, with the corners in meshio's
/// order; and the number of points.
struct MeshioFile {
  std::size_t points = 0;
  std::map<std::string, double> sizes;         // by meshio's name for the kind
  std::map<std::string, std::size_t> numbers;  // number of cells, by kind
};

/// Runs Python once for all files; none if there is no meshio. A file that meshio refuses has no points.
[[nodiscard]] std::optional<std::vector<MeshioFile>> read_by_meshio(const std::vector<std::filesystem::path>& files);

}  // namespace dmoscope::test
