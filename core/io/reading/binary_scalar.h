#pragma once
// Numbers in binary files: their type, their byte order, and the words of formats for types.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dmoscope {

enum class ScalarType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

/// Bytes of one number of this type.
[[nodiscard]] std::size_t size_of(ScalarType type) noexcept;
[[nodiscard]] bool is_whole(ScalarType type) noexcept;
/// The number at `bytes`. 64-bit whole numbers are rounded to the nearest double.
[[nodiscard]] double load_scalar(const char* bytes, ScalarType type, bool big_endian) noexcept;
/// The exact whole number at `bytes`; unsigned 64-bit ones above the signed range give -1. `type` must be whole.
[[nodiscard]] std::int64_t load_whole(const char* bytes, ScalarType type, bool big_endian) noexcept;
/// Writes `value`, rounded to the precision of `type`; whole types take the nearest number of their range.
void store_scalar(char* bytes, ScalarType type, bool big_endian, double value) noexcept;
/// The value that `type` would return after storing `value`.
[[nodiscard]] double rounded_to(ScalarType type, double value) noexcept;
/// Whether `type` holds `value` without rounding.
[[nodiscard]] bool holds_exactly(ScalarType type, double value) noexcept;

/// Finds the type of a file's word in VTK's or PLY's vocabulary ("unsigned_char", "uchar", "float32", "vtktypeint64", ...). Returns false
/// for any other word. VTK's "long" has 64 bits.
[[nodiscard]] bool scalar_of_word(std::string_view word, ScalarType& type) noexcept;
[[nodiscard]] std::string_view vtk_word(ScalarType type) noexcept;
/// Word of a type in PLY; 64-bit whole numbers, which PLY lacks, give "double".
[[nodiscard]] std::string_view ply_word(ScalarType type) noexcept;

}  // namespace dmoscope
