#pragma once
// Packs: several floats or doubles that one instruction works on, by xsimd. A pack is a scalar of formulas and search, and each of its
// slots gets exactly the bits that a plain float or double gets there: only operations that IEEE 754 defines are used, and no fused
// multiply-add changes a rounding.
//
// xsimd was chosen because it was the fastest library in Debian on the search's inner loop (ns a visit, AVX-512 / AVX2 / SSE2, g++ 12):
// xsimd 103 / 189 / 348, std::experimental::simd 279 / 521 / 952; Highway 1.0.3 does not accept g++ 12's flags for these processors. And
// its types carry their architecture, so that code compiled for one can never be linked in place of another's.

#include <cstddef>
#include <cstdint>

#include <xsimd/xsimd.hpp>

#include "core/numeric/scalar.h"

#if defined(__aarch64__)
namespace xsimd {
// Corrects xsimd 8, which approximates division and roots of floats on ARM, though the processor has instructions that round as IEEE 754
// demands.
template <>
inline batch<float, neon64>& batch<float, neon64>::operator/=(const batch<float, neon64>& other) noexcept {
  return *this = batch<float, neon64>(vdivq_f32(*this, other));
}
template <>
inline batch<float, neon64> sqrt<float, neon64>(const batch<float, neon64>& x) noexcept {
  return vsqrtq_f32(x);
}
}  // namespace xsimd
#endif

namespace dmoscope {

/// The widest pack of `T` that this translation unit is compiled for.
template <class T>
using Pack = xsimd::batch<T, xsimd::default_arch>;

namespace scalar {
template <class T, class Arch>
struct Constant<xsimd::batch<T, Arch>> {
  static xsimd::batch<T, Arch> of(double value) { return xsimd::batch<T, Arch>(static_cast<T>(value)); }
};

/// The sum as a * 1 + b, which rounds once, like a + b. The compiler must not see the 1, or it would make it a + b again.
template <>
struct Sum<Pack<float>> {
  using R = Pack<float>;
  static R of(R a, R b) {
#if defined(__AVX512F__)
    __m512 one = _mm512_set1_ps(1.0F);
    __asm__("" : "+v"(one));
    return _mm512_fmadd_ps(a, one, b);
#elif defined(__FMA__)
    __m256 one = _mm256_set1_ps(1.0F);
    __asm__("" : "+x"(one));
    return _mm256_fmadd_ps(a, one, b);
#else
    return a + b;
#endif
  }
};

/// The arc tangent with the bits of a double's; declared for this one type, so that it is taken before xsimd's own.
inline Pack<double> atan2(Pack<double> y, Pack<double> x) {
  using R = Pack<double>;
  const R width = xsimd::abs(x), height = xsimd::abs(y);
  const auto steep = height > width;
  const R large = xsimd::select(steep, height, width), small = xsimd::select(steep, width, height);
  const auto none = large == R(0.0);
  const R r = xsimd::select(none, R(0.0), small / xsimd::select(none, R(1.0), large));
  // Rounds without xsimd's floor: without an instruction for it that converts to integers, and slots that nobody reads may hold NaN.
  const R eighths = r * R(8.0) + R(0.5);
  R nearest(0.0), known_angle(KnownAngles::kTable[0]);
  for (std::size_t k = 1; k <= 8; ++k) {
    const R here(static_cast<double>(k));
    const auto below = eighths < here;
    nearest = xsimd::select(below, nearest, here);
    known_angle = xsimd::select(below, known_angle, R(KnownAngles::kTable[k]));
  }
  R angle = angle_from_known(r, nearest * R(0.125), known_angle);
  constexpr double kPi = 0x1.921fb54442d18p+1;
  angle = xsimd::select(steep, R(kPi / 2.0) - angle, angle);
  angle = xsimd::select(x < R(0.0), R(kPi) - angle, angle);
  return xsimd::select(y < R(0.0), R(0.0) - angle, angle);
}
inline Pack<double> cube_root(Pack<double> a) {
  using R = Pack<double>;
  const R size = xsimd::abs(a);
  alignas(64) double slots[R::size];
  size.store_aligned(slots);
  for (double& slot : slots) slot = rough_cube_root(slot);
  const R root = refined_cube_root(size, R::load_aligned(slots));
  return xsimd::select(size > R(0.0), xsimd::select(a < R(0.0), R(0.0) - root, root), a);
}

/// Least slot of a pack without NaN.
inline float least_slot(Pack<float> a) {
#if defined(__AVX512F__)
  return _mm512_reduce_min_ps(a);
#elif defined(__SSE2__)
#if defined(__AVX__)
  const __m128 quarter = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
#else
  const __m128 quarter = a;
#endif
  const __m128 pair = _mm_min_ps(quarter, _mm_movehl_ps(quarter, quarter));
  return _mm_cvtss_f32(_mm_min_ss(pair, _mm_shuffle_ps(pair, pair, 1)));
#else
  alignas(64) float slots[Pack<float>::size];
  a.store_aligned(slots);
  float least = slots[0];
  for (std::size_t k = 1; k < Pack<float>::size; ++k) least = slots[k] < least ? slots[k] : least;
  return least;
#endif
}
/// Bits of the slots, the first lowest.
inline std::uint32_t bits_of(xsimd::batch_bool<float, xsimd::default_arch> slots) {
#if defined(__AVX512F__)
  return static_cast<std::uint32_t>(slots.data);
#elif defined(__AVX__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(slots));
#elif defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_ps(slots));
#else
  alignas(64) float ones[Pack<float>::size];
  xsimd::select(slots, Pack<float>(1.0F), Pack<float>(0.0F)).store_aligned(ones);
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < Pack<float>::size; ++k) bits |= (ones[k] > 0.0F ? 1U : 0U) << k;
  return bits;
#endif
}
}  // namespace scalar

}  // namespace dmoscope
