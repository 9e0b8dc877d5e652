#pragma once
// Numbers as they lie in binary files: their type, their byte order, and the words that formats have for them.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dmoscope {

enum class ScalarType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

/// Bytes of one number of this type.
[[nodiscard]] std::size_t size_of(ScalarType type) noexcept;
[[nodiscard]] bool is_whole(ScalarType type) noexcept;
/// The number that starts at `bytes`. 64-bit whole numbers are rounded to the nearest double.
[[nodiscard]] double load_scalar(const char* bytes, ScalarType type, bool big_endian) noexcept;
/// The whole number that starts at `bytes`, exactly; unsigned 64-bit ones above the signed range give -1. `type` must be whole.
[[nodiscard]] std::int64_t load_whole(const char* bytes, ScalarType type, bool big_endian) noexcept;
/// Writes `value`, rounded to what `type` can hold; whole types take the nearest number of their range.
void store_scalar(char* bytes, ScalarType type, bool big_endian, double value) noexcept;
/// `value` as `type` would give it back.
[[nodiscard]] double rounded_to(ScalarType type, double value) noexcept;
/// True when `type` holds `value` without rounding.
[[nodiscard]] bool holds_exactly(ScalarType type, double value) noexcept;

/// The type that a file's word means, in VTK's or PLY's language ("unsigned_char", "uchar", "float32", "vtktypeint64", ...).
/// Returns false for any other word. VTK's "long" is 64 bits wide.
[[nodiscard]] bool scalar_of_word(std::string_view word, ScalarType& type) noexcept;
[[nodiscard]] std::string_view vtk_word(ScalarType type) noexcept;
/// PLY's word; 64-bit whole numbers, which PLY lacks, give "double".
[[nodiscard]] std::string_view ply_word(ScalarType type) noexcept;

}  // namespace dmoscope
