#pragma once
// Sets of indices that grow together.

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
  /// True when the two were apart.
  bool join(Index a, Index b) noexcept {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// For every index a parent in its set, never above it: an index is its own parent when it is its set's lowest.
  [[nodiscard]] std::vector<Index> take_parents() noexcept { return std::move(parent_); }

 private:
  std::vector<Index> parent_;
};

}  // namespace dmoscope
