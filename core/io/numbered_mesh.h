#pragma once
// Nodes and elements that a file numbers itself: with gaps, in any order, elements perhaps before their nodes.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/reading/source_file.h"
#include "core/io/tag_places.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

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
