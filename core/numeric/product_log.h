#pragma once
// The sum of the logarithms of many numbers, with equal bits on every processor: library logarithms differ in their last bits.

#include <cmath>
#include <numbers>

namespace dmoscope {

/// A product whose mantissa and power of two are kept apart, so that nothing over- or underflows; one logarithm at the end. It uses only
/// multiplications and divisions, which every processor rounds alike.
class ProductLog {
 public:
  /// Multiplies the product by a finite positive number.
  void multiply(double factor) {
    int power = 0, carry = 0;
    const double part = std::frexp(factor, &power);  // exact
    mantissa_ = std::frexp(mantissa_ * part, &carry);
    power_ += power + carry;
  }
  /// The natural logarithm of the product so far, right to a few last places of its parts.
  [[nodiscard]] double value() const {
    const bool low = mantissa_ < std::numbers::sqrt2 / 2.0;  // range [sqrt(1/2), sqrt(2)), where the series is short
    const double m = low ? 2.0 * mantissa_ : mantissa_;
    const double z = (m - 1.0) / (m + 1.0), square = z * z;
    double series = 1.0 / 23.0;  // ln m = 2 artanh z, |z| < 0.172
    for (int odd = 21; odd >= 1; odd -= 2) series = 1.0 / odd + square * series;
    return static_cast<double>(power_ - (low ? 1 : 0)) * std::numbers::ln2 + 2.0 * z * series;
  }

 private:
  double mantissa_ = 0.5;  // mantissa in [1/2, 1)
  long power_ = 1;
};

}  // namespace dmoscope
