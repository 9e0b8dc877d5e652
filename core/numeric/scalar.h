#pragma once
// Operations that formulas and search need of their scalar, for double and float. Packs (core/numeric/pack.h) have the same ones in their
// own namespace: callers use them unqualified, after `using`.

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "core/base/host_device.h"
#include "core/numeric/arc_tangent.h"

namespace dmoscope::scalar {

/// Makes a constant of the scalar from a double: Constant<R>::of(0.5).
template <class R>
struct Constant {
  static DMOSCOPE_ANYWHERE R of(double value) { return static_cast<R>(value); }
};
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R constant(double value) {
  return Constant<R>::of(value);
}

template <std::floating_point R>
[[nodiscard]] DMOSCOPE_ANYWHERE R select(bool condition, R yes, R no) {
  return condition ? yes : no;
}
/// The minimum. The result for two zeros, and for NaN, differs between processors: nothing may depend on it.
template <std::floating_point R>
[[nodiscard]] DMOSCOPE_ANYWHERE R min(R a, R b) {
#if defined(__CUDA_ARCH__)
  if constexpr (sizeof(R) == sizeof(float)) return ::fminf(a, b);  // one instruction instead of two
#endif
  return b < a ? b : a;
}
template <std::floating_point R>
[[nodiscard]] DMOSCOPE_ANYWHERE R max(R a, R b) {
#if defined(__CUDA_ARCH__)
  if constexpr (sizeof(R) == sizeof(float)) return ::fmaxf(a, b);
#endif
  return a < b ? b : a;
}
template <std::floating_point R>
[[nodiscard]] DMOSCOPE_ANYWHERE R abs(R a) {
  return std::fabs(a);
}
template <std::floating_point R>
[[nodiscard]] DMOSCOPE_ANYWHERE R sqrt(R a) {
  return std::sqrt(a);
}
template <std::floating_point R>
[[nodiscard]] DMOSCOPE_ANYWHERE R atan2(R y, R x) {
  return static_cast<R>(arc_tangent(static_cast<double>(y), static_cast<double>(x)));
}

/// First approximation of the cube root of a positive number, right to 6 %: a third of the exponent, by the bits (after Kahan).
[[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE double rough_cube_root(double size) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(size) / 3 + 0x2a9f7893782da1ceULL);
}
/// Refines a cube root by Halley's steps, each of which trebles the digits. R: double or a pack of it.
template <class R>
[[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE R refined_cube_root(R size, R root) {
  for (int step = 0; step < 3; ++step) {
    const R ratio = size / root / root / root;  // converges to 1; nothing overflows
    root = root * ((R(1.0) + ratio + ratio) / (R(2.0) + ratio));
  }
  return root;
}
/// The cube root, with equal bits on every processor, unlike the library's. Right to a few units in the last place; not for infinities and
/// NaN.
[[nodiscard]] DMOSCOPE_ANYWHERE double cube_root(double a) {
  const double size = a < 0.0 ? -a : a;
  if (!(size > 0.0)) return a;
  const double root = refined_cube_root(size, rough_cube_root(size));
  return a < 0.0 ? -root : root;
}
[[nodiscard]] DMOSCOPE_ANYWHERE float cube_root(float a) { return static_cast<float>(cube_root(static_cast<double>(a))); }

/// Whether the condition holds in any slot.
[[nodiscard]] DMOSCOPE_ANYWHERE bool any(bool condition) { return condition; }
/// The sum a + b with its bits; packs use their multiplier if the adders are the bottleneck: Sum<R>::of(a, b).
template <class R>
struct Sum {
  static DMOSCOPE_ANYWHERE R of(R a, R b) { return a + b; }
};

template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R max3(R a, R b, R c) {
  return max(max(a, b), c);
}
/// The quotient numerator / denominator, or 0 if the denominator is 0: an element shrunk to a point has quality 0, not NaN.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R ratio(R numerator, R denominator) {
  return select(denominator > R(0), numerator / select(denominator > R(0), denominator, R(1)), R(0));
}
/// The sign: -1, 0 or 1.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R sign(R a) {
  return select(a > R(0), R(1), select(a < R(0), R(-1), R(0)));
}

}  // namespace dmoscope::scalar
