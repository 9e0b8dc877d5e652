#pragma once
// Columns of a candidate grid that a round of the threshold search (core/search/ratio_search.h) looks at.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/base/host_device.h"
#include "core/numeric/scalar.h"

namespace dmoscope {

/// The columns of a grid that a round looks at. In a level's first round it is all eight, and upper bounds of their largest margins are
/// kept, rounded up to 16 bits, two in a register, because a lane has few registers.
class RoundColumns {
 public:
  [[nodiscard]] DMOSCOPE_ANYWHERE std::uint32_t bits() const { return bits_; }
  /// Keeps a bound of the largest margin of the next column, in the order of the columns; does nothing after the first round.
  DMOSCOPE_ANYWHERE void keep(float largest) {
    if (!is_first_) return;
    // Rounds up to the upper 16 bits, which order floats that are not negative.
    const std::uint32_t bound = (std::bit_cast<std::uint32_t>(scalar::max(largest, 0.0F)) + 0xffffU) >> 16U;
    DMOSCOPE_UNROLL
    for (std::size_t i = 0; i < 3; ++i) bounds_[i] = bounds_[i] >> 16U | bounds_[i + 1] << 16U;
    bounds_[3] = bounds_[3] >> 16U | bound << 16U;
  }
  /// Restricts the next round to the columns whose largest margin in the first may have been above `least`.
  DMOSCOPE_ANYWHERE void take_those_above(float least) {
    is_first_ = false;
    const std::uint32_t most_dropped = least < 0.0F ? 0U : std::bit_cast<std::uint32_t>(least) >> 16U;
    bits_ = 0;
    DMOSCOPE_UNROLL
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t bound = i % 2 == 0 ? bounds_[i / 2] & 0xffffU : bounds_[i / 2] >> 16U;
      bits_ |= bound > most_dropped || least < 0.0F ? 1U << i : 0U;
    }
  }

 private:
  std::array<std::uint32_t, 4> bounds_{};
  std::uint32_t bits_ = 0xff;  // bit i: column i
  bool is_first_ = true;
};

}  // namespace dmoscope
