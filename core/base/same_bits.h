#pragma once
// Equality to the last bit: 0 differs from -0, and a NaN equals itself.

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/vec.h"

namespace dmoscope {

[[nodiscard]] inline bool same_bits(double a, double b) noexcept {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
[[nodiscard]] inline bool same_bits(const Vec3& a, const Vec3& b) noexcept {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
[[nodiscard]] inline bool same_bits(std::span<const Vec3> a, std::span<const Vec3> b) noexcept {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

}  // namespace dmoscope
