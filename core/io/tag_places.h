#pragma once
// Lookup of nodes and elements by the numbers (Gmsh's tags) that a file gives them: with gaps and in any order.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// Places of tags. Add all tags in the order of their places, call finish(), then find(). Consecutive tags take no memory.
class TagPlaces {
 public:
  void add(std::int64_t tag) {
    if (count_ == 0) first_ = tag;
    if (consecutive_ && tag != first_ + static_cast<std::int64_t>(count_)) spell_out();
    if (!consecutive_) tags_.push_back(tag);
    ++count_;
  }
  /// Completes the lookup. Returns the place of a tag that an earlier place has, too, if there is one; the earlier one counts. Does nothing
  /// when called again.
  std::optional<Index> finish();
  /// The place of a tag, kNoIndex if there is none.
  [[nodiscard]] Index find(std::int64_t tag) const noexcept;
  /// Whether the tags are 1, 2, 3, ...
  [[nodiscard]] bool count_from_one() const noexcept { return consecutive_ && (count_ == 0 || first_ == 1); }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

 private:
  void spell_out();

  std::size_t count_ = 0;
  std::int64_t first_ = 1;
  bool consecutive_ = true;
  std::vector<std::int64_t> tags_;                      // all tags, unless they are consecutive
  std::int64_t least_ = 0;                              // tag of the first entry of dense_
  std::vector<Index> dense_;                            // places by tag, if there are few gaps
  std::vector<std::pair<std::int64_t, Index>> sorted_;  // places by tag, if there are many gaps
};

}  // namespace dmoscope
