#pragma once
// The few operations the formulas need of their scalar. Each executor's scalar (double, float, a pack of floats) offers these.

#include <cmath>
#include <concepts>
#include <cstddef>

#include <experimental/simd>

namespace dmoscope {

/// A pack of floats: the scalar of a lane that holds several vertices. Every operation does in each slot exactly what the plain float
/// does, so packs of any width and single floats find the same bits.
template <int Width>
using Pack = std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, Width>>;

namespace scalar {

/// A constant of the scalar from a double: Constant<R>::of(0.5).
template <class R>
struct Constant {
  static constexpr R of(double value) { return static_cast<R>(value); }
};
template <class R>
[[nodiscard]] constexpr R constant(double value) {
  return Constant<R>::of(value);
}

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

/// Does the condition hold in every slot?
[[nodiscard]] constexpr bool all(bool condition) { return condition; }

template <class Abi>
using PackOf = std::experimental::simd<float, Abi>;
template <class Abi>
using MaskOf = std::experimental::simd_mask<float, Abi>;

template <class Abi>
struct Constant<PackOf<Abi>> {
  static PackOf<Abi> of(double value) { return PackOf<Abi>(static_cast<float>(value)); }
};

template <class Abi>
[[nodiscard]] PackOf<Abi> select(MaskOf<Abi> condition, PackOf<Abi> yes, PackOf<Abi> no) {
  where(condition, no) = yes;
  return no;
}
template <class Abi>
[[nodiscard]] bool all(MaskOf<Abi> condition) {
  return std::experimental::all_of(condition);
}
template <class Abi>
[[nodiscard]] PackOf<Abi> min(PackOf<Abi> a, PackOf<Abi> b) {
  return scalar::select(b < a, b, a);
}
template <class Abi>
[[nodiscard]] PackOf<Abi> max(PackOf<Abi> a, PackOf<Abi> b) {
  return scalar::select(a < b, b, a);
}
template <class Abi>
[[nodiscard]] PackOf<Abi> abs(PackOf<Abi> a) {
  return std::experimental::abs(a);
}
template <class Abi>
[[nodiscard]] PackOf<Abi> sqrt(PackOf<Abi> a) {
  return std::experimental::sqrt(a);
}
template <class Abi>
[[nodiscard]] PackOf<Abi> atan2(PackOf<Abi> y, PackOf<Abi> x) {
  PackOf<Abi> result;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::atan2(static_cast<float>(y[i]), static_cast<float>(x[i]));
  return result;
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

}  // namespace scalar
}  // namespace dmoscope
