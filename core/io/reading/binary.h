#pragma once
// Numbers in binary files, of either byte order.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/progress.h"

namespace dmoscope {

/// The number at `bytes` (sizeof(Number) of them).
template <class Number>
requires std::is_arithmetic_v<Number>
[[nodiscard]] Number load_number(const char* bytes, bool big_endian) noexcept {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes, raw.size());
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

/// The bytes of a number in a byte order.
template <class Number>
requires std::is_arithmetic_v<Number>
[[nodiscard]] std::array<char, sizeof(Number)> store_number(Number value, bool big_endian) noexcept {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  return raw;
}

/// Reader of binary data; every error is an InputError without a line.
class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, std::size_t offset, bool big_endian, std::string file, Progress& progress)
      : bytes_(bytes), offset_(offset), big_endian_(big_endian), file_(std::move(file)), progress_(&progress) {}

  [[nodiscard]] std::size_t offset() const noexcept { return offset_; }
  [[nodiscard]] std::size_t remaining() const noexcept { return bytes_.size() - offset_; }
  /// Reads the next number; `what` names it in the error if the file ends before it.
  template <class Number>
  [[nodiscard]] Number read(std::string_view what) {
    require(sizeof(Number), what);
    const Number value = load_number<Number>(bytes_.data() + offset_, big_endian_);
    offset_ += sizeof(Number);
    if (offset_ >= next_report_) report();
    return value;
  }
  void skip(std::size_t count, std::string_view what) {
    require(count, what);
    offset_ += count;
    if (offset_ >= next_report_) report();
  }
  /// Throws InputError unless `count` entries of `bytes_each` are left; to be called before allocating memory for them.
  void require_count(std::uint64_t count, std::size_t bytes_each, std::string_view what) const {
    if (count > remaining() / bytes_each) {
      fail(fmt::format("truncated: {} {} need more than the {} bytes left", count, what, remaining()));
    }
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_, 0, what); }

 private:
  void require(std::size_t count, std::string_view what) const {
    if (count > remaining()) fail(fmt::format("truncated: the file ends in {}", what));
  }
  void report() {
    next_report_ = offset_ + (std::size_t{1} << 20);
    progress_->check();
    progress_->set(static_cast<double>(offset_) / static_cast<double>(bytes_.size() + 1));
  }

  std::string_view bytes_;
  std::size_t offset_;
  bool big_endian_;
  std::string file_;
  Progress* progress_;
  std::size_t next_report_ = 0;
};

/// Least whole number above which not every whole number is a double.
inline constexpr double kExactWhole = 9007199254740992.0;

// Numbers in binary files: their type, their byte order, and the words of formats for types.

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
