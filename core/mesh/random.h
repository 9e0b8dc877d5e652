#pragma once
// Random numbers that are equal on every machine (those of std distributions are not).

#include <cstdint>

namespace dmoscope {

/// The splitmix64 generator (Steele, Lea, Flood 2014): 64 bits of state, full period, any seed is fine.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed) {}
  constexpr std::uint64_t next() noexcept {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  /// Uniform in [0, bound), without bias: draws beyond the largest multiple of `bound` are thrown away. bound > 0.
  constexpr std::uint64_t below(std::uint64_t bound) noexcept {
    const std::uint64_t rejected = (0 - bound) % bound;  // 2^64 mod bound
    std::uint64_t draw = next();
    while (draw < rejected) draw = next();
    return draw % bound;
  }
  /// Uniform in [0, 1), a multiple of 2^-53.
  constexpr double unit() noexcept { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  /// Uniform in [low, high).
  constexpr double between(double low, double high) noexcept { return low + (high - low) * unit(); }

 private:
  std::uint64_t state_;
};

}  // namespace dmoscope
