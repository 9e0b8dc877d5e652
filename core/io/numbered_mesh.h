#pragma once
// Nodes and elements that a file calls by numbers of its own: with gaps, in any order, elements perhaps before the nodes they name.

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
  /// `source` must outlive this; it gets the places of the nodes.
  explicit NumberedMesh(SourceFile& source) : source_(source) {}

  /// `place`: byte offset of the node's coordinates.
  void add_node(std::int32_t number, Vec3 position, std::size_t place);
  /// corners_of(shape) node numbers; `place`: byte offset of the element.
  void add_cell(std::int32_t number, CellShape shape, std::span<const std::int32_t> nodes, std::uint32_t origin, std::size_t place);
  /// Call it when all are there: gives the mesh its positions, and finds every node that an element names. Throws InputError at the line
  /// of a node or element whose number is taken, or of an element that names a node which is not there.
  void finish(Mesh& mesh);

  // After finish().
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
  std::vector<std::int32_t> corners_;  // numbers of nodes, of all cells one after the other
  std::vector<CellShape> shapes_;
  std::vector<std::uint32_t> origins_;
  std::vector<std::uint64_t> places_;  // of cells
  TagPlaces node_tags_, cell_tags_;
  CellTable cells_;
};

}  // namespace dmoscope
