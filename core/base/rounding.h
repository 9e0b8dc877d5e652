#pragma once
// Rounding to single precision.

#include <type_traits>

#include "core/base/host_device.h"

namespace dmoscope {

/// The nearest 32-bit float, as a double. Through memory, one number at a time: if g++ 12 packs two such conversions into one vector, it
/// leaves both out and returns the numbers unrounded. Always inlined: see core/smooth/displace.h.
[[nodiscard, gnu::always_inline]] DMOSCOPE_ANYWHERE double nearest_float(double value) noexcept {
  auto rounded = static_cast<float>(value);
#if !defined(__CUDA_ARCH__)
  if (!std::is_constant_evaluated()) __asm__("" : "+m"(rounded));
#endif
  return static_cast<double>(rounded);
}

}  // namespace dmoscope
