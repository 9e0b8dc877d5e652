#pragma once
// Symbolic analysis of a sparse Cholesky factor: which columns are kept and eliminated together, and which rows they have.

#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/nested_dissection.h"

namespace dmoscope {

/// Columns first to end of the factor with the same rows below them, or nearly: a missing row is kept as 0.
struct Supernode {
  Index first = 0, end = 0;
  Index parent = kNoIndex;             // its parent in the tree of supernodes: the node with the first of the rows
  std::size_t rows = 0, rows_end = 0;  // range in SupernodeTree::rows
  std::size_t zeros = 0;               // number of pairs of row and column that are kept in vain
  [[nodiscard]] std::size_t width() const { return end - first; }
  [[nodiscard]] std::size_t below() const { return rows_end - rows; }
  [[nodiscard]] std::size_t height() const { return width() + below(); }
};

struct SupernodeTree {
  std::vector<Index> order;        // vertex of each column
  std::vector<Supernode> nodes;    // by columns, so that children come before their parent
  std::vector<Index> rows;         // rows of each node below its own columns, ascending
  std::vector<Index> parent_rows;  // number of each of these rows among the parent's columns and rows
};

/// `order`: the vertices in the order of elimination, which is kept but for parts that do not depend on each other.
[[nodiscard]] SupernodeTree find_supernodes(const Adjacency& graph, std::span<const Index> order);

}  // namespace dmoscope
