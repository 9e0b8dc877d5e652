#pragma once
// Bytes as base64 text (RFC 4648).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope {

[[nodiscard]] std::string to_base64(std::span<const std::uint8_t> bytes);
/// Decodes a text. None if it is not base64.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

/// Reads base64 piece by piece. Skips blanks and line ends between the digits, and after the padding of one run of base64 another one may
/// follow (as in VTK's XML files).
class Base64Reader {
 public:
  explicit Base64Reader(std::string_view text) : text_(text) {}
  /// Appends the next `count` bytes to `out`. False if the text ends before that, or is no base64; `out` is then unchanged.
  [[nodiscard]] bool read(std::size_t count, std::vector<char>& out);
  /// Number of characters read; a group of four digits is read whole.
  [[nodiscard]] std::size_t position() const noexcept { return at_; }

 private:
  /// Decodes the next four digits.
  [[nodiscard]] bool next_group();

  std::string_view text_;
  std::size_t at_ = 0;
  char group_[3] = {};
  std::size_t used_ = 0;   // bytes of the group that were already returned
  std::size_t count_ = 0;  // bytes in the group
};

}  // namespace dmoscope
