#pragma once
// Rounding to single precision.

namespace dmoscope {

/// The nearest 32-bit float, as a double. Through memory, one number at a time: where g++ 12 packs two such conversions into one
/// vector it leaves both out and returns the numbers as they were. Always inlined: see core/smooth/displace.h.
[[nodiscard, gnu::always_inline]] inline double nearest_float(double value) noexcept {
  const volatile auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace dmoscope
