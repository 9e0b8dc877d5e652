#include "core/numeric/elementary.h"

#include <cmath>
#include <cstdint>

namespace dmoscope::elementary {

namespace {

constexpr double kMost = 700.0;
// ln 2 and pi / 2 in parts: the first have so few digits that a whole number times them is exact.
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
constexpr double kHalfPi1 = 0x1.921fb544p+0, kHalfPi2 = 0x1.0b4611a6p-34, kHalfPi3 = 0x1.3198a2e037073p-69;

/// The sine and cosine of |x| <= pi / 4 by their series; the first term left out is below 1e-18.
double sine_series(double x) {
  const double s = x * x;
  double sum = 0.0;
  for (int k = 19; k >= 3; k -= 2) sum = (1.0 + sum) * (-s / (k * (k - 1)));
  return x + x * sum;
}
double cosine_series(double x) {
  const double s = x * x;
  double sum = 0.0;
  for (int k = 20; k >= 2; k -= 2) sum = (1.0 + sum) * (-s / (k * (k - 1)));
  return 1.0 + sum;
}

/// The sine of x + quarters * pi / 2.
double sine_after(double x, std::int64_t quarters) {
  if (!(x > -1e9 && x < 1e9)) return 0.0;
  const double turns = std::floor(x / (kHalfPi1 + kHalfPi2) + 0.5);
  const double rest = ((x - turns * kHalfPi1) - turns * kHalfPi2) - turns * kHalfPi3;
  switch ((static_cast<std::int64_t>(turns) + quarters) & 3) {
    case 0:
      return sine_series(rest);
    case 1:
      return cosine_series(rest);
    case 2:
      return -sine_series(rest);
    default:
      return -cosine_series(rest);
  }
}

}  // namespace

double exponential(double x) {
  if (!(x < kMost)) x = x != x ? 0.0 : kMost;
  if (x < -kMost) x = -kMost;
  const double whole = std::floor(x / (kLn2High + kLn2Low) + 0.5);
  const double r = (x - whole * kLn2High) - whole * kLn2Low;
  double sum = 1.0;
  for (int k = 14; k >= 1; --k) sum = 1.0 + sum * r / k;
  return std::ldexp(sum, static_cast<int>(whole));
}

double logarithm(double x) {
  if (!(x > 0.0)) return -kMost;
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // 0.5 to 1
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --exponent;
  }
  const double f = (m - 1.0) / (m + 1.0), s = f * f;
  double sum = 0.0;
  for (int odd = 25; odd >= 3; odd -= 2) sum = (sum + 1.0 / odd) * s;
  const double e = exponent, value = e * kLn2High + (2.0 * f + (2.0 * f * sum + e * kLn2Low));
  return value < kMost ? (value > -kMost ? value : -kMost) : kMost;
}

double sine(double x) { return sine_after(x, 0); }
double cosine(double x) { return sine_after(x, 1); }

double power(double x, double y) {
  if (!(x > 0.0)) return 0.0;
  return exponential(y * logarithm(x));
}

}  // namespace dmoscope::elementary
