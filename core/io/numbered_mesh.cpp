#include "core/io/numbered_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/reading/tokenizer.h"

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

void NumberedMesh::add_node(std::int32_t number, Vec3 position, std::size_t place) {
  node_numbers_.push_back(number);
  node_tags_.add(number);
  positions_.push_back(position);
  source_.add_place(place);
}

void NumberedMesh::add_cell(std::int32_t number, CellShape shape, std::span<const std::int32_t> nodes, std::uint32_t origin,
                            std::size_t place) {
  cell_numbers_.push_back(number);
  cell_tags_.add(number);
  corners_.insert(corners_.end(), nodes.begin(), nodes.end());
  shapes_.push_back(shape);
  origins_.push_back(origin);
  places_.push_back(place);
}

void NumberedMesh::finish(Mesh& mesh) {
  if (const auto twice = node_tags_.finish()) {
    fail_at(source_.place(*twice), fmt::format("node {} a second time", node_numbers_[*twice]));
  }
  if (const auto twice = cell_tags_.finish()) fail_at(places_[*twice], fmt::format("element {} a second time", cell_numbers_[*twice]));
  if (!node_tags_.count_from_one()) source_.add_only_in_file("the numbers of its nodes");
  if (!cell_tags_.count_from_one()) source_.add_only_in_file("the numbers of its elements");
  cells_.reserve_more(shapes_.size(), corners_.size());
  const std::int32_t* at = corners_.data();
  for (std::size_t c = 0; c < shapes_.size(); ++c) {
    std::array<Index, 8> corners{};
    for (Index k = 0; k < corners_of(shapes_[c]); ++k, ++at) {
      corners[k] = node_tags_.find(*at);
      if (corners[k] == kNoIndex) {
        fail_at(places_[c], fmt::format("element {} names node {}, which the file does not have", cell_numbers_[c], *at));
      }
    }
    cells_.add(shapes_[c], corners.data(), origins_[c]);
  }
  mesh.positions = std::move(positions_);
}

void NumberedMesh::fail_at(std::size_t place, const std::string& what) const {
  Progress unwatched;
  const Tokenizer tokens(source_.bytes(), source_.path().string(), {}, unwatched);
  tokens.fail_at(tokens.line_at(place), what);
}

}  // namespace dmoscope
