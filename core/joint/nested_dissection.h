#pragma once
// Order of elimination that keeps the factor of a sparse matrix sparse.

#include <array>
#include <span>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// Adjacency of a graph, both directions of its edges, without loops: the neighbours of vertex i, ascending, are neighbours[offsets[i]] to
/// neighbours[offsets[i + 1]]. offsets: one more than there are vertices.
struct Adjacency {
  std::vector<Index> offsets{0};
  std::vector<Index> neighbours;
  [[nodiscard]] std::span<const Index> of(Index vertex) const {
    return {neighbours.data() + offsets[vertex], neighbours.data() + offsets[vertex + 1]};
  }
};

/// The graph of lists of neighbours in any order, each neighbour any number of times.
[[nodiscard]] Adjacency adjacency_of(std::vector<std::vector<Index>> neighbours);

/// Nested dissection (George 1973). Each part is halved by its longest coordinate and by a breadth-first search, and the smaller of the two
/// separators is taken. `places`: rough position of each vertex. Returns the vertices in that order; ties are broken by index.
template <int D>
[[nodiscard]] std::vector<Index> nested_dissection(const Adjacency& graph, std::span<const std::array<double, D>> places);

}  // namespace dmoscope
