#pragma once
// How much a file may become in memory, so that one of a few kilobytes does not fill all of it.

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace dmoscope {

/// How many bytes a file may unpack to. Each piece is taken from the budget before its memory is allocated.
class UnpackBudget {
 public:
  /// `most`: the limit that the user gave; 0: none. Then a file may become a hundred times as large, and 256 MiB in any case:
  /// real ones, even those of constant fields, stay far below.
  UnpackBudget(std::size_t file_bytes, std::uint64_t most) noexcept : left_(UnpackBudget::most(file_bytes, most)) {}
  /// The bytes that such a file may become.
  [[nodiscard]] static constexpr std::uint64_t most(std::size_t file_bytes, std::uint64_t most) noexcept {
    return most != 0 ? most : std::max(kAlways, kTimes * file_bytes);
  }
  /// False: that is more than is left.
  [[nodiscard]] bool take(std::uint64_t bytes) noexcept {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }
  /// For the error: "the file of 103 kB unpacks to more than 256 MiB; ..." is said by who reads.
  [[nodiscard]] static constexpr const char* advice() noexcept {
    return "more than a file of this size should; --max-memory SIZE (in a script: max-memory SIZE) says how much is fine";
  }

 private:
  static constexpr std::uint64_t kAlways = std::uint64_t{256} << 20U;
  static constexpr std::uint64_t kTimes = 100;
  std::uint64_t left_;
};

}  // namespace dmoscope
