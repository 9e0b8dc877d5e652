#pragma once
// A scalar with its first and second derivatives by N variables: with it the formulas give the exact gradient and Hessian of every metric,
// as dual.h gives the gradient.

#include <array>
#include <cmath>
#include <cstddef>

#include "core/numeric/scalar.h"

namespace dmoscope {

/// A value with first and second derivatives. Comparisons are those of the values. At a kink of a formula (the lesser of two angles) the
/// derivatives are those of the branch that it takes; where a slope is infinite (a root at 0) they are 0.
template <std::size_t N>
struct SecondDual {
  double value = 0.0;
  std::array<double, N> first{};               // derivatives by variable i
  std::array<double, N*(N + 1) / 2> second{};  // derivatives by variables i and j <= i, at i (i + 1) / 2 + j

  constexpr SecondDual() = default;
  constexpr explicit SecondDual(double v) : value(v) {}
  /// Variable i with the value v.
  [[nodiscard]] static constexpr SecondDual variable(double v, std::size_t i) {
    SecondDual result(v);
    result.first[i] = 1.0;
    return result;
  }
  [[nodiscard]] constexpr double second_by(std::size_t i, std::size_t j) const {
    return i < j ? second[j * (j + 1) / 2 + i] : second[i * (i + 1) / 2 + j];
  }

  /// Applies a function with the value `f`, the slope `slope` and the second derivative `bend` here.
  [[nodiscard]] constexpr SecondDual through(double f, double slope, double bend) const {
    SecondDual result(f);
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      result.first[i] = slope * first[i];
      const double bent = bend * first[i];
      for (std::size_t j = 0; j <= i; ++j, ++k) result.second[k] = slope * second[k] + bent * first[j];
    }
    return result;
  }

  friend constexpr SecondDual operator+(const SecondDual& a, const SecondDual& b) { return a.plus(b, 1.0); }
  friend constexpr SecondDual operator-(const SecondDual& a, const SecondDual& b) { return a.plus(b, -1.0); }
  friend constexpr SecondDual operator*(const SecondDual& a, const SecondDual& b) {
    SecondDual result(a.value * b.value);
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      result.first[i] = b.value * a.first[i] + a.value * b.first[i];
      for (std::size_t j = 0; j <= i; ++j, ++k)
        result.second[k] = (b.value * a.second[k] + a.value * b.second[k]) + (a.first[i] * b.first[j] + b.first[i] * a.first[j]);
    }
    return result;
  }
  /// The quotient q, by differentiation of a = q b: a'' = q'' b + q' b' + b' q' + q b''.
  friend constexpr SecondDual operator/(const SecondDual& a, const SecondDual& b) {
    SecondDual q(a.value / b.value);
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      q.first[i] = (a.first[i] - q.value * b.first[i]) / b.value;
      for (std::size_t j = 0; j <= i; ++j, ++k)
        q.second[k] = ((a.second[k] - q.value * b.second[k]) - (q.first[i] * b.first[j] + b.first[i] * q.first[j])) / b.value;
    }
    return q;
  }
  friend constexpr bool operator<(const SecondDual& a, const SecondDual& b) { return a.value < b.value; }
  friend constexpr bool operator>(const SecondDual& a, const SecondDual& b) { return a.value > b.value; }
  friend constexpr bool operator<=(const SecondDual& a, const SecondDual& b) { return a.value <= b.value; }
  friend constexpr bool operator==(const SecondDual& a, const SecondDual& b) { return a.value == b.value; }

  friend constexpr SecondDual select(bool condition, const SecondDual& yes, const SecondDual& no) { return condition ? yes : no; }
  friend constexpr SecondDual min(const SecondDual& a, const SecondDual& b) { return b < a ? b : a; }
  friend constexpr SecondDual max(const SecondDual& a, const SecondDual& b) { return a < b ? b : a; }
  friend constexpr SecondDual abs(const SecondDual& a) { return a.value < 0.0 ? a.through(-a.value, -1.0, 0.0) : a; }
  friend SecondDual sqrt(const SecondDual& a) {
    const double root = std::sqrt(a.value);
    if (!(root > 0.0)) return SecondDual(root);
    return a.through(root, 0.5 / root, -0.25 / (root * a.value));
  }
  friend constexpr SecondDual cube_root(const SecondDual& a) {
    const double root = scalar::cube_root(a.value), square = root * root;
    if (!(square > 0.0)) return SecondDual(root);
    return a.through(root, 1.0 / (3.0 * square), -2.0 / (9.0 * square * a.value));
  }
  friend constexpr SecondDual atan2(const SecondDual& y, const SecondDual& x) {
    const double square = x.value * x.value + y.value * y.value;
    SecondDual angle(scalar::atan2(y.value, x.value));
    if (!(square > 0.0)) return angle;
    const double by_y = x.value / square, by_x = -y.value / square;
    const double by_yx = (by_x * by_x) - (by_y * by_y), by_yy = 2.0 * by_x * by_y, by_xx = -by_yy;
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      angle.first[i] = by_y * y.first[i] + by_x * x.first[i];
      for (std::size_t j = 0; j <= i; ++j, ++k)
        angle.second[k] = (by_y * y.second[k] + by_x * x.second[k]) + (by_yy * y.first[i] * y.first[j] + by_xx * x.first[i] * x.first[j]) +
                          by_yx * (y.first[i] * x.first[j] + x.first[i] * y.first[j]);
    }
    return angle;
  }

 private:
  [[nodiscard]] constexpr SecondDual plus(const SecondDual& b, double sign) const {
    SecondDual result(value + sign * b.value);
    for (std::size_t i = 0; i < first.size(); ++i) result.first[i] = first[i] + sign * b.first[i];
    for (std::size_t k = 0; k < second.size(); ++k) result.second[k] = second[k] + sign * b.second[k];
    return result;
  }
};

}  // namespace dmoscope
