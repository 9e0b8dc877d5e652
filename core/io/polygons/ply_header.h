#pragma once
// The header of a PLY file: the elements that follow, and their properties. Format: Greg Turk, "The PLY Polygon File Format", 1994.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/io/reading/binary.h"
#include "core/io/reading/mixed_input.h"

namespace dmoscope {

enum class PlyEncoding : std::uint8_t { Ascii, LittleEndian, BigEndian };

struct PlyProperty {
  std::string name;
  std::string type_word;  // word in the file
  ScalarType type = ScalarType::Float32;
  bool list = false;
  ScalarType count_type = ScalarType::UInt8;  // type of a list's count
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t place = 0;  // byte offset of its line in the header
  /// Bytes of one element in a binary file, the least possible if it has lists; words in an ASCII file.
  [[nodiscard]] std::size_t least_size(PlyEncoding encoding) const noexcept;
  [[nodiscard]] bool has_list() const noexcept;
  /// Index of the property with this name, or properties.size() if there is none.
  [[nodiscard]] std::size_t find(std::string_view property) const noexcept;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::string title;  // the first comment
  std::vector<PlyElement> elements;
};

/// Reads the header up to and including the line end after "end_header". Throws InputError with the line.
[[nodiscard]] PlyHeader read_ply_header(MixedInput& in);

}  // namespace dmoscope
