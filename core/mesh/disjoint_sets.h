#pragma once
// Disjoint sets of indices that can be joined.

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/memory.h"
#include "core/base/vec.h"

namespace dmoscope {

/// Disjoint sets with path halving. The root of a set is its lowest index.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(large_vector<Index>(count)) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  [[nodiscard]] Index find(Index i) noexcept {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins the sets of a and b. True if they were disjoint.
  bool join(Index a, Index b) noexcept {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// Moves out the parents, one for each index and never above it: the lowest index of a set is its own parent.
  [[nodiscard]] std::vector<Index> take_parents() noexcept { return std::move(parent_); }

 private:
  std::vector<Index> parent_;
};

}  // namespace dmoscope
