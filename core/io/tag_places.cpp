#include "core/io/tag_places.h"

#include <algorithm>

namespace dmoscope {

void TagPlaces::spell_out() {
  consecutive_ = false;
  tags_.reserve(2 * count_ + 1);
  for (std::size_t i = 0; i < count_; ++i) tags_.push_back(first_ + static_cast<std::int64_t>(i));
}

std::optional<Index> TagPlaces::finish() {
  if (consecutive_ || tags_.empty()) return std::nullopt;
  std::optional<Index> twice;
  const auto [least, largest] = std::minmax_element(tags_.begin(), tags_.end());
  const std::uint64_t span = static_cast<std::uint64_t>(*largest) - static_cast<std::uint64_t>(*least);
  if (span / 4 <= count_) {
    least_ = *least;
    dense_.assign(span + 1, kNoIndex);
    for (std::size_t i = 0; i < count_; ++i) {
      Index& place = dense_[static_cast<std::size_t>(tags_[i] - least_)];
      if (place == kNoIndex) {
        place = static_cast<Index>(i);
      } else if (!twice) {
        twice = static_cast<Index>(i);
      }
    }
  } else {
    sorted_.reserve(count_);
    for (std::size_t i = 0; i < count_; ++i) sorted_.emplace_back(tags_[i], static_cast<Index>(i));
    std::sort(sorted_.begin(), sorted_.end());
    const auto same = std::adjacent_find(sorted_.begin(), sorted_.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
    if (same != sorted_.end()) twice = (same + 1)->second;
  }
  tags_ = {};
  return twice;
}

Index TagPlaces::find(std::int64_t tag) const noexcept {
  if (consecutive_) {
    const std::uint64_t place = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_);
    return place < count_ ? static_cast<Index>(place) : kNoIndex;
  }
  if (!dense_.empty()) {
    const std::uint64_t place = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(least_);
    return place < dense_.size() ? dense_[place] : kNoIndex;
  }
  const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<std::int64_t, Index>{tag, 0});
  return found != sorted_.end() && found->first == tag ? found->second : kNoIndex;
}

}  // namespace dmoscope
