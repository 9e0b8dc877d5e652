#pragma once
// Every edge of a planar or surface mesh with the elements on its sides: one table for orientation, boundary and checks.

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// An edge between two distinct vertices, low < high.
struct Edge {
  Index low;
  Index high;
};

/// Edges in ascending order of (low, high), built in linear time for bounded valence. Three-dimensional elements are left out.
/// A side is the way from one corner of an element to its next, named by the place of the first in ElementTable::all_corners().
/// Sides whose two ends are one vertex (degenerate elements) are left out. Reversing the winding of an element
/// renames its sides but leaves the edges and the elements on them as they are.
class EdgeTable {
 public:
  explicit EdgeTable(const Mesh& mesh);
  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(edges_.size()); }
  [[nodiscard]] Edge edge(Index i) const noexcept { return edges_[i]; }
  /// The sides that lie on an edge, ascending: one on the boundary, two inside, more where the mesh is not manifold.
  [[nodiscard]] std::span<const Index> sides(Index i) const noexcept { return {sides_.data() + first_[i], sides_.data() + first_[i + 1]}; }
  /// The element a side belongs to.
  [[nodiscard]] Index element(Index side) const noexcept { return uniform_ != 0 ? side / uniform_ : owner_[side]; }

 private:
  void collect(const Mesh& mesh);

  std::vector<Edge> edges_;
  std::vector<Index> first_;
  std::vector<Index> sides_;
  Index uniform_ = 0;         // corners of each element where all have the same number, else 0
  std::vector<Index> owner_;  // element of each side, empty where uniform_ tells
};

/// Number of closed boundary curves. Where several curves touch in one vertex, a curve goes on along the fan of elements it borders.
/// Edges with more than two elements are no boundary here. A curve that is interrupted by such an edge counts once.
[[nodiscard]] Index count_boundary_loops(const Mesh& mesh, const EdgeTable& edges);

}  // namespace dmoscope
