#pragma once
// Interfaces that the parts of Gmsh's MSH formats share.
// https://gmsh.info/doc/texinfo/gmsh.html#Gmsh-file-formats

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/numbered_mesh.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/mixed_input.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Type number in Gmsh of each CellShape; the corners come in the same order.
inline constexpr std::array<std::int64_t, kCellShapeCount> kGmshTypes{15, 1, 2, 3, 4, 5, 6, 7};
inline constexpr std::string_view kGmshPhysical = "physical group";       // role of groups
inline constexpr std::string_view kGmshEntity = "entity";                 // role of groups of cells without a physical group
inline constexpr std::string_view kGmshGeometrical = "gmsh:geometrical";  // field of the elements' entities, named as by other tools

/// Writer, see FormatHandler. Version 2.2, ASCII, which most programs read. Throws OutputError, Cancelled.
Notes write_gmsh(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

// Cursor over an MSH file: numbers are words in an ASCII file and bytes in a binary one.

class GmshInput {
 public:
  GmshInput(const SourceFile& source, Progress& progress) : words(source, progress) {}

  /// Goes to the bytes that follow in a binary file: leaves the present line.
  void begin_data() {
    if (binary) (void)words.rest_of_line();
  }
  /// Reads an int.
  [[nodiscard]] int whole(std::string_view what);
  /// Reads a size_t of version 4.1.
  [[nodiscard]] std::int64_t size(std::string_view what);
  [[nodiscard]] double real(std::string_view what);
  /// Reads a count (size_t) of entries that the rest of the file can hold, each of `text` or `bytes` bytes. Throws InputError.
  [[nodiscard]] std::size_t count(std::string_view what, double text, double bytes);
  /// Decodes a number of a block from words.block().
  [[nodiscard]] int int_at(const char* bytes) const noexcept { return load_number<std::int32_t>(bytes, big_endian); }
  [[nodiscard]] std::int64_t size_at(const char* bytes) const noexcept { return load_number<std::int64_t>(bytes, big_endian); }
  [[nodiscard]] double real_at(const char* bytes) const noexcept { return load_number<double>(bytes, big_endian); }

  MixedInput words;
  bool binary = false;
  bool big_endian = false;
  int version = 0;  // 2, or 4 for 4.1

 private:
  std::int64_t any_count(std::int64_t n, std::string_view what) const;
};

// Elements of an MSH file, and their groups.

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
  /// Calls read(dimension) for each entity of a section, behind their counts.
  template <class Read>
  void each_entity(Read read);
  /// Reads the bounds of an entity, its physical groups, which it returns, and the entities that bound it.
  std::vector<int> end_entity(int dimension);
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

// Sections $NodeData and $ElementData of an MSH file.

class GmshData {
 public:
  GmshData(GmshInput& in, SourceFile& source) : in_(in), source_(source), room_(kLeastRoom + source.bytes().size()) {}

  /// Reads a section behind the word that begins it; `tags` are the numbers of all nodes or elements of the file. Throws InputError,
  /// Cancelled.
  void read(Field::On on, const TagPlaces& tags);
  /// Adds a field for each section, NaN where it has no value. `rows`: the file's element of each element of the mesh; empty: all.
  void add_to(Mesh& mesh, std::span<const Index> rows);

 private:
  static constexpr std::size_t kLeastRoom = 65536;

  /// Header of the values, always in words.
  struct Head {
    std::string name;
    std::size_t components = 0;
    std::size_t values = 0;  // number of nodes or elements with values
  };
  Head read_head();
  void keep_rows(Field& field, std::span<const Index> rows);

  GmshInput& in_;
  SourceFile& source_;
  std::size_t room_;           // values that may still be read: data of a few nodes must not need many times the file's size in memory
  std::vector<Field> fields_;  // fields with a row for each node or element of the file
};

}  // namespace dmoscope
