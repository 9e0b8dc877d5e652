#include "core/io/numbered_mesh.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

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
