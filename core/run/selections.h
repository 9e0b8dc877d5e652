#pragma once
// Vertices and edges that the user selects for a run: those that stay or slide, corners and feature edges.

#include <string>
#include <string_view>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/reference/kinds.h"
#include "core/run/parameters.h"

namespace dmoscope {

/// Vertices by words, see vertices_named(), and by their numbers.
struct VertexSelection {
  std::string_view option;  // begins messages about it: "--fix"
  std::vector<std::string> words{};
  std::vector<Index> numbers{};
  [[nodiscard]] bool empty() const noexcept { return words.empty() && numbers.empty(); }
};

/// Edges by words, see edges_named(), and by their ends.
struct EdgeSelection {
  std::string_view option;
  std::vector<std::string> words{};
  std::vector<EdgeEnds> ends{};
  [[nodiscard]] bool empty() const noexcept { return words.empty() && ends.empty(); }
};

struct Selections {
  VertexSelection fix{"--fix"}, slide{"--slide"}, corner{"--corner"}, no_corner{"--no-corner"};
  EdgeSelection feature{"--feature"}, no_feature{"--no-feature"};
  /// Whether no corner and no feature edge is selected.
  [[nodiscard]] bool no_kinds() const noexcept { return corner.empty() && no_corner.empty() && feature.empty() && no_feature.empty(); }
};

/// Sets the fixed vertices, and where vertices are selected to slide those of the boundary that stay. Throws UsageError.
void fix_and_slide(RunParameters& parameters, const InputMesh& input, const Selections& selections);
/// Corners and feature edges. Appends sentences on those without effect by the parameters to `warnings`. Throws UsageError, also if all of
/// an option have none.
[[nodiscard]] Kinds kinds_of(const InputMesh& input, const RunParameters& parameters, const Selections& selections,
                             std::vector<std::string>& warnings);

}  // namespace dmoscope
