#pragma once
// The XML of a VTU or VTP file (VTK's UnstructuredGrid and PolyData), and the attributes of its arrays. Format:
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "core/base/progress.h"
#include "core/base/thread_pool.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

/// A DataArray element.
struct VtuArray {
  pugi::xml_node node;
  std::string name;
  ScalarType type = ScalarType::Float64;
  std::size_t components = 1;
  bool ascii = false;
  bool appended = false;
  bool base64 = false;
  std::size_t begin = 0, limit = 0;  // range in the file of its numbers, which begin at `begin` and end at `limit` or before
};

class VtuDocument {
 public:
  /// Parses a document; `source` must outlive this. Throws InputError with the line.
  VtuDocument(const SourceFile& source, Progress& progress) : VtuDocument(source, source.bytes().size(), progress) {}
  /// Parses the head of a file of `file_size` bytes, which is all that the source holds, up to the underscore before the appended data.
  VtuDocument(const SourceFile& source, std::size_t file_size, Progress& progress);

  [[nodiscard]] pugi::xml_node grid() const noexcept { return grid_; }
  /// Whether it is one of the grids whose cells are not listed (.vts, .vtr, .vti).
  [[nodiscard]] bool structured() const noexcept { return structured_; }
  /// Whether it is PolyData (.vtp), whose cells are in lists of one kind each.
  [[nodiscard]] bool is_poly() const noexcept { return poly_; }
  [[nodiscard]] bool big_endian() const noexcept { return big_endian_; }
  [[nodiscard]] ScalarType header() const noexcept { return header_; }
  [[nodiscard]] bool compressed() const noexcept { return !compressor_.empty(); }
  [[nodiscard]] const std::string& compressor() const noexcept { return compressor_; }
  [[nodiscard]] std::string_view bytes() const noexcept { return source_.bytes(); }
  [[nodiscard]] std::string file() const { return source_.path().string(); }
  [[nodiscard]] Progress& progress() const noexcept { return progress_; }
  /// The bytes before the appended data: all that is XML.
  [[nodiscard]] std::string_view xml() const noexcept { return bytes().substr(0, appended_begin_); }

  /// A count in an attribute, at most `most`.
  [[nodiscard]] std::size_t count(pugi::xml_node node, const char* attribute, std::size_t most) const;
  /// The attributes of a DataArray. Throws InputError; none for an array of strings or another type without numbers.
  [[nodiscard]] std::optional<VtuArray> array(pugi::xml_node node) const;
  /// An array in appended data: its element, and its begin in the file.
  struct Appended {
    pugi::xml_node node;
    std::size_t offset;  // value of the attribute
    std::size_t begin;
  };
  [[nodiscard]] std::vector<Appended> appended() const;
  /// Place of an attribute's value in the file: begin and size.
  [[nodiscard]] std::pair<std::size_t, std::size_t> attribute_place(pugi::xml_node node, std::string_view attribute) const;

  /// Line of a byte, from 1. Counts from the byte asked for last: cheap for bytes that are near each other.
  [[nodiscard]] std::size_t line_at(std::size_t offset) const;
  /// Throws InputError at the line of an element, naming it.
  [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const;
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const;

 private:
  void cut_appended();
  void parse();
  void attributes(pugi::xml_node file);
  [[nodiscard]] std::size_t place_of(pugi::xml_node node) const;
  void find_inline_text(VtuArray& array) const;

  const SourceFile& source_;
  Progress& progress_;
  std::string xml_;  // parsed in place
  pugi::xml_document document_;
  pugi::xml_node grid_;
  bool structured_ = false, poly_ = false;
  bool big_endian_ = false;
  ScalarType header_ = ScalarType::UInt32;
  std::string compressor_;
  std::size_t file_size_;
  std::size_t appended_begin_ = 0, appended_end_ = 0;      // range of the data itself, behind its underscore
  mutable std::size_t counted_at_ = 0, counted_line_ = 1;  // a byte and its line
  bool has_appended_ = false;
  bool appended_base64_ = false;
};

// Numbers of a VTU file's arrays, in any encoding.

/// The bytes of an array that is not ASCII, in the file's byte order.
struct VtuData {
  std::vector<char> owned;  // decoded bytes; `bytes` points here, or into the file
  std::string_view bytes;
  std::size_t end = 0;    // end in the file, with header and padding
  std::size_t block = 0;  // bytes in a block, 0 if it is not compressed
};

/// Separators of the numbers of an ASCII array: the next tag ends them.
[[nodiscard]] TextSyntax vtu_text_syntax();

/// The bytes of an array that is not ASCII. Throws InputError unless there are `expected` of them.
[[nodiscard]] VtuData vtu_data(const VtuDocument& document, const VtuArray& array, std::size_t expected);

/// The numbers of an array, which may be infinite or NaN. Throws InputError unless there are `expected` of them. `places`: gets the offset
/// of each in the file, if the array is ASCII. `end`: gets the array's end in the file, if it is not ASCII. `budget`: pays for the numbers
/// of arrays that are not ASCII.
[[nodiscard]] std::vector<double> vtu_numbers(const VtuDocument& document, const VtuArray& array, std::size_t expected, std::size_t& end,
                                              UnpackBudget& budget, std::vector<std::uint64_t>* places = nullptr);
/// The numbers of an array as whole numbers; those beyond 63 bits are -1. See vtu_numbers().
[[nodiscard]] std::vector<std::int64_t> vtu_wholes(const VtuDocument& document, const VtuArray& array, std::size_t expected,
                                                   std::size_t& end, UnpackBudget& budget);

/// Encoding of arrays that are not ASCII.
struct VtuEncoding {
  bool big_endian = false;
  ScalarType header = ScalarType::UInt64;  // type of the sizes before an array: UInt32 or UInt64
  bool zlib = true;
  bool base64 = false;
  std::size_t block = 32768;  // bytes in a block that is compressed separately
};

/// An array in the form of the file: its sizes and its bytes, which are in the encoding's byte order. Throws OutputError (through `file`)
/// if the sizes do not fit the header's type.
[[nodiscard]] std::string vtu_encoded(const std::string& file, std::string_view bytes, const VtuEncoding& encoding, ThreadPool* pool);

}  // namespace dmoscope
