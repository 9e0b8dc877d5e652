#pragma once
// Elementary functions with equal bits on every processor, unlike the library's, as they use only operations that IEEE 754 defines. Each is
// right to a few units in the last place and defined for every number; an argument outside of the domain has the value of the nearest
// inside.

#include <bit>
#include <cstdint>

#include "core/base/host_device.h"

namespace dmoscope::elementary {

namespace parts {

inline constexpr double kMost = 700.0;
// Constants ln 2 and pi / 2 in parts: the first have so few digits that a whole number times them is exact.
inline constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
inline constexpr double kHalfPi1 = 0x1.921fb544p+0, kHalfPi2 = 0x1.0b4611a6p-34, kHalfPi3 = 0x1.3198a2e037073p-69;

/// The nearest whole number, of two the greater one, for |x| below 1e15.
[[nodiscard]] DMOSCOPE_ANYWHERE std::int64_t nearest_whole(double x) {
  const double above = x + 0.5;
  const auto cut = static_cast<std::int64_t>(above);
  return static_cast<double>(cut) > above ? cut - 1 : cut;
}
/// The product x * 2^exponent, if neither 2^exponent nor the product is subnormal or too large.
[[nodiscard]] DMOSCOPE_ANYWHERE double scaled(double x, std::int64_t exponent) {
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
}

/// The sine and cosine of |x| <= pi / 4 by their series; the first term left out is below 1e-18.
[[nodiscard]] DMOSCOPE_ANYWHERE double sine_series(double x) {
  const double s = x * x;
  double sum = 0.0;
  for (int k = 19; k >= 3; k -= 2) sum = (1.0 + sum) * (-s / (k * (k - 1)));
  return x + x * sum;
}
[[nodiscard]] DMOSCOPE_ANYWHERE double cosine_series(double x) {
  const double s = x * x;
  double sum = 0.0;
  for (int k = 20; k >= 2; k -= 2) sum = (1.0 + sum) * (-s / (k * (k - 1)));
  return 1.0 + sum;
}

/// The sine of x + quarters * pi / 2.
[[nodiscard]] DMOSCOPE_ANYWHERE double sine_after(double x, std::int64_t quarters) {
  if (!(x > -1e9 && x < 1e9)) return 0.0;
  const std::int64_t whole = nearest_whole(x / (kHalfPi1 + kHalfPi2));
  const auto turns = static_cast<double>(whole);
  const double rest = ((x - turns * kHalfPi1) - turns * kHalfPi2) - turns * kHalfPi3;
  const std::int64_t quarter = (whole + quarters) & 3;
  const double value = (quarter & 1) == 0 ? sine_series(rest) : cosine_series(rest);
  return quarter < 2 ? value : -value;
}

}  // namespace parts

/// The function e^x; beyond +-700 its value at +-700.
[[nodiscard]] DMOSCOPE_ANYWHERE double exponential(double x) {
  using namespace parts;
  if (!(x < kMost)) x = x != x ? 0.0 : kMost;
  if (x < -kMost) x = -kMost;
  const std::int64_t whole = nearest_whole(x / (kLn2High + kLn2Low));
  const double r = (x - static_cast<double>(whole) * kLn2High) - static_cast<double>(whole) * kLn2Low;
  double sum = 1.0;
  for (int k = 14; k >= 1; --k) sum = 1.0 + sum * r / k;
  return scaled(sum, whole);
}

/// The natural logarithm; -700 for numbers that are not positive.
[[nodiscard]] DMOSCOPE_ANYWHERE double logarithm(double x) {
  using namespace parts;
  if (!(x > 0.0)) return -kMost;
  constexpr double kLeastNormal = 0x1p-1022;
  const bool subnormal = x < kLeastNormal;
  const auto bits = std::bit_cast<std::uint64_t>(subnormal ? x * 0x1p54 : x);
  if (bits >> 52U == 0x7ffU) return kMost;
  std::int64_t exponent = static_cast<std::int64_t>(bits >> 52U) - 1022 - (subnormal ? 54 : 0);
  double m = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3fe0000000000000ULL);  // 0.5 to 1
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --exponent;
  }
  const double f = (m - 1.0) / (m + 1.0), s = f * f;
  double sum = 0.0;
  for (int odd = 25; odd >= 3; odd -= 2) sum = (sum + 1.0 / odd) * s;
  const auto e = static_cast<double>(exponent);
  const double value = e * kLn2High + (2.0 * f + (2.0 * f * sum + e * kLn2Low));
  return value < kMost ? (value > -kMost ? value : -kMost) : kMost;
}

/// The sine of an angle in radians; 0 beyond +-1e9, where a double hardly determines the angle.
[[nodiscard]] DMOSCOPE_ANYWHERE double sine(double x) { return parts::sine_after(x, 0); }
[[nodiscard]] DMOSCOPE_ANYWHERE double cosine(double x) { return parts::sine_after(x, 1); }

/// The power x^y by way of the logarithm; 0 for x <= 0.
[[nodiscard]] DMOSCOPE_ANYWHERE double power(double x, double y) {
  if (!(x > 0.0)) return 0.0;
  return exponential(y * logarithm(x));
}

}  // namespace dmoscope::elementary
