#pragma once
// VTK legacy files, versions 1.0 to 5.1, ASCII and BINARY: POLYDATA, UNSTRUCTURED_GRID, and structured grids,
// whose cells become quadrilaterals or hexahedra.
// Format: "The VTK User's Guide", VTK File Formats; https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/binary.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/mixed_input.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Writer of new files: UNSTRUCTURED_GRID, ASCII, version 3.0; see FormatHandler::write.
std::vector<std::string> write_vtk(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

// Sequences of numbers in a VTK legacy file: words in an ASCII file, big-endian blocks in a BINARY one.

/// A data type of VTK. Bits are packed eight to a byte in binary files; strings and variants are only skipped, and so are types unknown to
/// VTK.
struct VtkType {
  enum class Kind : std::uint8_t { Scalar, Bit, String, Unknown };
  Kind kind = Kind::Scalar;
  ScalarType scalar = ScalarType::Float64;
};

class VtkValues {
 public:
  VtkValues(const SourceFile& source, Progress& progress) : in(source, progress) {}

  /// Takes the word for a data type. Throws InputError for one that VTK does not know.
  VtkType type();
  /// Takes the word for a data type; the kind is Unknown for a word that VTK does not know.
  VtkType any_type();
  /// Takes a count of values of `type` that begin on the next line, checked against the rest of the file.
  std::size_t count(std::string_view what, const VtkType& type);
  /// Least number of bytes of a value in this file.
  [[nodiscard]] double least_bytes(const VtkType& type) const noexcept;
  /// Reads n numbers: each(value, offset of the value in the file). Bits are 0 and 1.
  template <class Each>
  void numbers(const VtkType& type, std::size_t n, std::string_view what, Each&& each);
  /// Reads n whole numbers, exactly.
  template <class Each>
  void wholes(const VtkType& type, std::size_t n, std::string_view what, Each&& each);
  /// Skips n values of an unknown type, which `what` names. Throws InputError in a binary file, where their size is unknown.
  void skip_unknown(std::size_t n, std::string_view what);
  /// Skips n strings.
  void skip_strings(std::size_t n);
  /// Skips a METADATA block, whose word was taken, up to an empty line.
  void skip_metadata();

  MixedInput in;
  bool binary = false;

 private:
  /// Takes binary data, which begin right after the newline that ends their header.
  std::string_view block(std::size_t n, std::size_t bytes_each, std::string_view what);
};

template <class Each>
void VtkValues::numbers(const VtkType& type, std::size_t n, std::string_view what, Each&& each) {
  in.need(n, least_bytes(type), what);
  if (!binary) {
    for (std::size_t i = 0; i < n; ++i) {
      const double value = in.number(what);
      each(value, in.token());
    }
  } else if (type.kind == VtkType::Kind::Bit) {
    const std::string_view bits = block((n + 7) / 8, 1, what);
    for (std::size_t i = 0; i < n; ++i) each(static_cast<double>((bits[i / 8] >> (7 - i % 8)) & 1), in.token() + i / 8);
  } else {
    const std::size_t size = size_of(type.scalar);
    const std::string_view data = block(n, size, what);
    for (std::size_t i = 0; i < n; ++i) each(load_scalar(data.data() + i * size, type.scalar, true), in.token() + i * size);
  }
}

template <class Each>
void VtkValues::wholes(const VtkType& type, std::size_t n, std::string_view what, Each&& each) {
  in.need(n, least_bytes(type), what);
  if (type.kind != VtkType::Kind::Scalar || !is_whole(type.scalar)) in.fail(std::string(what) + " must be of a whole-number type");
  if (!binary) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::int64_t value = in.integer(what);
      each(value, in.token());
    }
  } else {
    const std::size_t size = size_of(type.scalar);
    const std::string_view data = block(n, size, what);
    const std::size_t start = in.token();
    for (std::size_t i = 0; i < n; ++i) each(load_whole(data.data() + i * size, type.scalar, true), start + i * size);
  }
}

// Point and cell data of a VTK legacy file.

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
