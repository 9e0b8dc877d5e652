#pragma once
// Statistics gathered block by block.

#include <array>
#include <limits>
#include <span>

#include "core/quality/element_block.h"

namespace dmoscope {

/// The share of some elements in the statistics.
class Tally {
 public:
  /// Four interleaved sums (element i adds to sum i mod 4), so that no addition waits for the one before, over stretches of this many
  /// elements. Whoever needs the same bits must add in the same order.
  static constexpr std::size_t kLanes = 4, kStretch = 1024;

  /// `immovable`: ascending, at least those elements of the block whose corners are all fixed (see immovable_elements).
  void add(const ElementBlock& block, std::span<const Index> immovable);
  /// `next`: of elements that follow those of this one.
  void append(const Tally& next);
  [[nodiscard]] Statistics statistics() const;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  double minimum_ = kInfinity, movable_ = kInfinity, ceiling_ = kInfinity;
  std::array<double, kLanes> sums_{};
  Index worst_ = kNoIndex, inverted_ = 0;
  std::size_t defined_ = 0;
};

/// The tallies of a mesh's stretches, added up in their order: first those of each group, then the groups. So groups can be added by
/// different processes.
class TallyTotal {
 public:
  static constexpr std::size_t kGroup = 1024;  // stretches

  /// `stretch`: the next one.
  void append(const Tally& stretch);
  [[nodiscard]] Statistics statistics() const;

 private:
  Tally groups_, group_;
  std::size_t in_group_ = 0;
};

}  // namespace dmoscope
