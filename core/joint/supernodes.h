#pragma once
// Which columns of a sparse Cholesky factor are kept and eliminated together, and which rows they have: the symbolic analysis.

#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/nested_dissection.h"

namespace dmoscope {

/// Columns first to end of the factor with the same rows below them, or nearly: what one lacks is kept as 0.
struct Supernode {
  Index first = 0, end = 0;
  Index parent = kNoIndex;             // in the tree of supernodes: that with the first of the rows
  std::size_t rows = 0, rows_end = 0;  // in SupernodeTree::rows
  std::size_t zeros = 0;               // how many pairs of row and column are kept in vain
  [[nodiscard]] std::size_t width() const { return end - first; }
  [[nodiscard]] std::size_t below() const { return rows_end - rows; }
  [[nodiscard]] std::size_t height() const { return width() + below(); }
};

struct SupernodeTree {
  std::vector<Index> order;        // the vertex of each column
  std::vector<Supernode> nodes;    // by columns, so that children come before their parent
  std::vector<Index> rows;         // of each node below its own columns, ascending
  std::vector<Index> parent_rows;  // for each of them, its number among the parent's columns and rows
};

/// `order`: the vertices in the order of elimination, which is kept but for parts that do not depend on each other.
[[nodiscard]] SupernodeTree find_supernodes(const Adjacency& graph, std::span<const Index> order);

}  // namespace dmoscope
