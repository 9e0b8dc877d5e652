#pragma once
// Elements of an MSH file, and their groups.

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/gmsh/gmsh_input.h"
#include "core/io/tag_places.h"

namespace dmoscope {

/// Reads $Elements, $Entities and $PhysicalNames. Throws InputError, Cancelled.
class GmshCells {
 public:
  GmshCells(GmshInput& in, SourceFile& source) : in_(in), source_(source) {}

  // Readers of sections, called behind the word that begins the section.
  void physical_names();
  void entities();
  void partitioned_entities();
  void elements(const TagPlaces& nodes);

  [[nodiscard]] bool elements_read() const noexcept { return elements_read_; }
  [[nodiscard]] const CellTable& cells() const noexcept { return cells_; }
  /// The number of every cell in the file.
  [[nodiscard]] TagPlaces& tags() noexcept { return tags_; }
  /// Adds elements, groups and the field of entities to the mesh, after all sections are read. See split_cells.
  [[nodiscard]] std::vector<Index> add_to(Mesh& mesh);

 private:
  /// Entity and physical groups that cells have in common.
  struct Origin {
    int dimension, entity;
    std::vector<int> physical;
  };

  void elements_2(const TagPlaces& nodes);
  void binary_elements_2(std::size_t count, const TagPlaces& nodes);
  void elements_4(const TagPlaces& nodes);
  void block_4(const TagPlaces& nodes, std::size_t count);
  void entity(int dimension);
  void partitioned_entity(int dimension);
  std::vector<int> read_physical();
  [[nodiscard]] std::pair<int, int> whole_of(int dimension, int entity) const;
  CellShape shape(std::int64_t type) const;
  Index node(std::int64_t tag, const TagPlaces& nodes, std::size_t place) const;
  std::uint32_t origin_of(int dimension, int physical, int entity);
  std::vector<OriginLabels> labels() const;
  void add_entity_field(Mesh& mesh, std::span<const Index> rows) const;

  GmshInput& in_;
  SourceFile& source_;
  CellTable cells_;
  TagPlaces tags_;
  std::vector<Origin> origins_;
  std::map<std::tuple<int, int, int>, std::uint32_t> origin_numbers_;  // origins by dimension, physical group (version 2) and entity
  std::tuple<int, int, int> last_key_{-1, 0, 0};
  std::uint32_t last_origin_ = 0;
  std::map<std::pair<int, int>, std::string> names_;                 // names of physical groups, by dimension and number
  std::map<std::pair<int, int>, std::vector<int>> entity_physical_;  // physical groups by dimension and entity
  std::map<std::pair<int, int>, std::pair<int, int>> whole_;         // by dimension and entity of a partition, the whole entity
  std::size_t skipped_ = 0;                                          // number of elements that are no cells: between two partitions
  bool elements_read_ = false;
};

}  // namespace dmoscope
