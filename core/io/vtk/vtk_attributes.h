#pragma once
// Point and cell data of a VTK legacy file.

#include <string>
#include <vector>

#include "core/io/reading/source_file.h"
#include "core/io/vtk/vtk_values.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Reads data attributes. Data that become no field (lookup tables, strings, data of neither points nor cells) are named in the source.
class VtkAttributes {
 public:
  VtkAttributes(VtkValues& values, SourceFile& source) : values_(values), source_(source) {}

  /// Begins the attributes of `count` points or cells, behind POINT_DATA or CELL_DATA. Throws InputError if the file has another count.
  void begin(Field::On on, std::size_t count, std::string_view keyword);
  /// Reads the attribute that begins with `keyword`, the word taken last; false if none does. Before begin(), only FIELD is possible.
  bool read(std::string_view keyword);
  /// The fields read; those of cells have a row for each cell of the file.
  [[nodiscard]] std::vector<Field>& fields() noexcept { return fields_; }

 private:
  void scalars();
  void color_scalars();
  void lookup_table();
  void texture_coordinates();
  void fixed(std::string_view role, int components);
  void field_arrays();
  void field_array();
  std::string name();
  void append(std::string name, std::string_view role, std::string_view type_word, const VtkType& type, std::size_t components,
              std::size_t tuples, double scale = 1.0);
  VtkType type(std::string& word);
  VtkType type_of_scalars(const std::string& name, std::string& word, std::size_t& components);
  std::size_t components(std::size_t most);

  VtkValues& values_;
  SourceFile& source_;
  bool begun_ = false;
  Field::On on_ = Field::On::Vertices;
  std::size_t count_ = 0;
  std::vector<Field> fields_;
};

/// A data name in VTK's encoding: blanks, quotes, percent signs and bytes beyond ASCII as %XX; the other function decodes.
[[nodiscard]] std::string vtk_encoded(std::string_view name);
[[nodiscard]] std::string vtk_decoded(std::string_view word);

}  // namespace dmoscope
