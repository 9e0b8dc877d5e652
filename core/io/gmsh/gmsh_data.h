#pragma once
// Sections $NodeData and $ElementData of an MSH file.

#include <span>
#include <string>
#include <vector>

#include "core/io/gmsh/gmsh_input.h"
#include "core/io/tag_places.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

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
