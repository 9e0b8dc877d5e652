#pragma once
// From the numbers (Gmsh's tags) that a file gives its nodes and elements to their places: they may have gaps and come in any order.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// Add all tags in the order of the things that have them, call finish(), then find(). Tags that count on one after the other take no
/// memory.
class TagPlaces {
 public:
  void add(std::int64_t tag) {
    if (count_ == 0) first_ = tag;
    if (consecutive_ && tag != first_ + static_cast<std::int64_t>(count_)) spell_out();
    if (!consecutive_) tags_.push_back(tag);
    ++count_;
  }
  /// The place of a tag that another one had before it, if there is such a one; the first counts.
  /// Done once; nothing when called again.
  std::optional<Index> finish();
  /// The place of a tag, kNoIndex if there is none.
  [[nodiscard]] Index find(std::int64_t tag) const noexcept;
  /// Are they 1, 2, 3, ...?
  [[nodiscard]] bool count_from_one() const noexcept { return consecutive_ && (count_ == 0 || first_ == 1); }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

 private:
  void spell_out();

  std::size_t count_ = 0;
  std::int64_t first_ = 1;
  bool consecutive_ = true;
  std::vector<std::int64_t> tags_;                      // of all, unless they are consecutive
  std::int64_t least_ = 0;                              // what dense_ begins with
  std::vector<Index> dense_;                            // by tag, where there are few gaps
  std::vector<std::pair<std::int64_t, Index>> sorted_;  // by tag, where there are many
};

}  // namespace dmoscope
