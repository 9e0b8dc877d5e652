#pragma once
// Nodes and elements that a file numbers itself: with gaps, in any order, elements perhaps before their nodes.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/vec.h"
#include "core/io/cell_table.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

// Lookup of nodes and elements by the numbers (Gmsh's tags) that a file gives them: with gaps and in any order.

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

class NumberedMesh {
 public:
  /// Begins a mesh. `source` must outlive this; it gets the offsets of the nodes.
  explicit NumberedMesh(SourceFile& source) : source_(source) {}

  /// Adds a node. `place`: byte offset of its coordinates.
  void add_node(std::int32_t number, Vec3 position, std::size_t place);
  /// Adds a cell with corners_of(shape) node numbers; `place`: byte offset of the element.
  void add_cell(std::int32_t number, CellShape shape, std::span<const std::int32_t> nodes, std::uint32_t origin, std::size_t place);
  /// Gives the mesh its positions, and looks up the nodes of all elements; to be called after all are added. Throws InputError at the line
  /// of a node or element with a repeated number, or of an element that names a missing node.
  void finish(Mesh& mesh);

  // --- Valid after finish() ---
  [[nodiscard]] const CellTable& cells() const noexcept { return cells_; }
  /// The vertex of a node's number, kNoIndex if there is none.
  [[nodiscard]] Index vertex(std::int64_t number) const noexcept { return node_tags_.find(number); }
  /// The cell of an element's number, kNoIndex if there is none.
  [[nodiscard]] Index cell(std::int64_t number) const noexcept { return cell_tags_.find(number); }

  [[nodiscard]] std::size_t node_count() const noexcept { return positions_.size(); }
  [[nodiscard]] std::size_t cell_count() const noexcept { return shapes_.size(); }
  [[nodiscard]] std::span<const std::int32_t> node_numbers() const noexcept { return node_numbers_; }
  [[nodiscard]] std::span<const std::int32_t> cell_numbers() const noexcept { return cell_numbers_; }

 private:
  [[noreturn]] void fail_at(std::size_t place, const std::string& what) const;

  SourceFile& source_;
  std::vector<Vec3> positions_;
  std::vector<std::int32_t> node_numbers_, cell_numbers_;
  std::vector<std::int32_t> corners_;  // node numbers of all cells, one after the other
  std::vector<CellShape> shapes_;
  std::vector<std::uint32_t> origins_;
  std::vector<std::uint64_t> places_;  // byte offsets of the cells
  TagPlaces node_tags_, cell_tags_;
  CellTable cells_;
};

}  // namespace dmoscope
