#pragma once
// The few operations the formulas need of their scalar. Each executor's scalar (double, float, a pack of floats) offers these.

#include <cmath>
#include <concepts>
#include <numbers>

namespace dmoscope::scalar {

template <std::floating_point R>
[[nodiscard]] constexpr R select(bool condition, R yes, R no) {
  return condition ? yes : no;
}
template <std::floating_point R>
[[nodiscard]] constexpr R min(R a, R b) {
  return b < a ? b : a;
}
template <std::floating_point R>
[[nodiscard]] constexpr R max(R a, R b) {
  return a < b ? b : a;
}
template <std::floating_point R>
[[nodiscard]] R abs(R a) {
  return std::fabs(a);
}
template <std::floating_point R>
[[nodiscard]] R sqrt(R a) {
  return std::sqrt(a);
}
template <std::floating_point R>
[[nodiscard]] R atan2(R y, R x) {
  return std::atan2(y, x);
}

template <class R>
[[nodiscard]] constexpr R min3(R a, R b, R c) {
  return scalar::min(scalar::min(a, b), c);
}
template <class R>
[[nodiscard]] constexpr R max3(R a, R b, R c) {
  return scalar::max(scalar::max(a, b), c);
}
/// numerator / denominator, and 0 where the denominator is 0: an element shrunk to a point has quality 0, not NaN.
template <class R>
[[nodiscard]] constexpr R ratio(R numerator, R denominator) {
  return scalar::select(denominator > R(0), numerator / scalar::select(denominator > R(0), denominator, R(1)), R(0));
}
/// -1, 0 or 1.
template <class R>
[[nodiscard]] constexpr R sign(R a) {
  return scalar::select(a > R(0), R(1), scalar::select(a < R(0), R(-1), R(0)));
}

}  // namespace dmoscope::scalar
