#pragma once
// A grid of candidates from which half-spaces are cut off: what is left is convex, so of each row of candidates an interval. A search that
// knows of each candidate it looks at a half-space without better ones needs to look at few (Levin 1965, Newman 1965: the method of centres
// of gravity, here the middle of the longest row).
//
// Only the kernels' sources include it; see lane_kernel_impl.h for what that asks of the code.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/numeric/pack.h"

namespace dmoscope::volumes {

/// Where `at_least` + `slope` . (p - `from`) is negative there is nothing better. It has room for rounding, and so must the cut.
struct GridCut {
  Vec3Of<float> from, slope;
  float at_least = 0.0F;
};

/// F: pack of floats, a row of candidates per slot.
template <class F>
class GridCuts {
 public:
  static constexpr std::size_t kMaxPoints = 64;  // per axis

  /// Of n candidates per axis. To be called again where n changes.
  void set_points(std::size_t n) {
    n_ = n;
    rows_ = n * n;
    const float middle = 0.5F * static_cast<float>(n - 1);
    for (std::size_t i = 0, row = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j, ++row) {
        i_[row] = static_cast<float>(i);
        j_[row] = static_cast<float>(j);
        const float di = i_[row] - middle, dj = j_[row] - middle;
        const float off_centre = 63.0F * (di * di + dj * dj) / (2.0F * middle * middle);
        key_[row] = static_cast<float>((63 - static_cast<std::size_t>(off_centre)) * kKeys + row);
      }
    }
    for (; rows_ % kWidth != 0; ++rows_) i_[rows_] = j_[rows_] = key_[rows_] = 0.0F;
  }

  /// Candidate (i, j, k) is where `x[i]`, `y[j]`, `z[k]` say. All are in question.
  void begin(const float* x, const float* y, const float* z) {
    reach_ = {reach_of(x), reach_of(y), reach_of(z)};
    first_ = {x[0], y[0], z[0]};
    const float steps = static_cast<float>(n_ - 1);
    step_ = {(x[n_ - 1] - x[0]) / steps, (y[n_ - 1] - y[0]) / steps, (z[n_ - 1] - z[0]) / steps};
    for (std::size_t row = 0; row < rows_; row += kWidth) {
      F(0.0F).store_aligned(low_ + row);
      F(steps).store_aligned(high_ + row);
    }
    for (std::size_t row = n_ * n_; row < rows_; ++row) drop(row);
  }

  /// Takes the half-space out, and finds the longest row that is left.
  void cut(const GridCut& cut) {
    using scalar::max;
    using scalar::min;
    const float room =
        kRounding * (std::fabs(cut.slope.x) * reach_.x + std::fabs(cut.slope.y) * reach_.y + std::fabs(cut.slope.z) * reach_.z);
    // At candidate (i, j, k): base + slope_i * i + slope_j * j + rise * k.
    const float rise = cut.slope.z * step_.z;
    const float inverse = 1.0F / (std::fabs(rise) > kLeastRise ? rise : kLeastRise);
    const F base((cut.at_least + room) + cut.slope.x * (first_.x - cut.from.x) + cut.slope.y * (first_.y - cut.from.y) +
                 cut.slope.z * (first_.z - cut.from.z));
    const F slope_i(cut.slope.x * step_.x), slope_j(cut.slope.y * step_.y), back(-inverse), beyond(static_cast<float>(n_)), before(-1.0F);
    F longest(-1.0F);
    const auto each_row = [&](auto narrow) {
      for (std::size_t row = 0; row < rows_; row += kWidth) {
        const F value = (base + slope_i * F::load_aligned(i_ + row)) + slope_j * F::load_aligned(j_ + row);
        F low = F::load_aligned(low_ + row), high = F::load_aligned(high_ + row);
        narrow(max(min(value * back, beyond), before), low, high, row);
        longest = max(longest, key_of(low, high, row));
      }
    };
    if (inverse > 0.0F) {
      each_row([this](const F& bound, F& low, const F& /*high*/, std::size_t row) {
        low = max(low, nearest(bound + F(kUp)));
        low.store_aligned(low_ + row);
      });
    } else {
      each_row([this](const F& bound, const F& /*low*/, F& high, std::size_t row) {
        high = min(high, nearest(bound - F(kUp)));
        high.store_aligned(high_ + row);
      });
    }
    take_longest(longest);
  }

  /// The largest coordinates of candidates.
  [[nodiscard]] Vec3Of<float> reach() const { return reach_; }

  /// Looks for the longest row anew.
  void find_longest() {
    using scalar::max;
    F longest(-1.0F);
    for (std::size_t row = 0; row < rows_; row += kWidth)
      longest = max(longest, key_of(F::load_aligned(low_ + row), F::load_aligned(high_ + row), row));
    take_longest(longest);
  }

  [[nodiscard]] bool empty() const { return longest_ >= rows_; }
  /// Of the longest row.
  [[nodiscard]] std::size_t row() const { return longest_; }
  [[nodiscard]] std::size_t low() const { return static_cast<std::size_t>(low_[longest_]); }
  [[nodiscard]] std::size_t high() const { return static_cast<std::size_t>(high_[longest_]); }
  [[nodiscard]] bool in_question(std::size_t row, std::size_t k) const {
    const auto place = static_cast<float>(k);
    return low_[row] <= place && place <= high_[row];
  }
  void drop(std::size_t row) { low_[row] = high_[row] + 1.0F; }

 private:
  static constexpr std::size_t kWidth = F::size;
  static constexpr std::size_t kKeys = kMaxPoints * kMaxPoints;
  static constexpr std::size_t kMaxRows = kMaxPoints * kMaxPoints + kWidth;
  static constexpr float kRounding = 1e-6F;   // of the cut's terms
  static constexpr float kLeastRise = 1e-30F;
  static constexpr float kUp = 0.499F;        // a bound within 0.001 of a candidate leaves it in question

  [[nodiscard]] float reach_of(const float* axis) const {
    const float first = std::fabs(axis[0]), last = std::fabs(axis[n_ - 1]);
    return first > last ? first : last;
  }
  /// To the nearest whole number, for numbers below 2^22.
  [[nodiscard]] static F nearest(F a) {
    const F magic(12582912.0F);  // 1.5 * 2^23
    return (a + magic) - magic;
  }

  /// Of rows of one length the middle one is taken; the key also tells which row it is. A whole number below 2^24, so it is exact; negative
  /// where nothing is left of the row.
  [[nodiscard]] F key_of(F low, F high, std::size_t row) const {
    return (high - low) * F(static_cast<float>(64 * kKeys)) + F::load_aligned(key_ + row);
  }
  void take_longest(F keys) {
    alignas(64) float slots[kWidth];
    keys.store_aligned(slots);
    float most = slots[0];
    for (std::size_t k = 1; k < kWidth; ++k) most = most < slots[k] ? slots[k] : most;
    longest_ = most < 0.0F ? ~std::size_t{0} : static_cast<std::size_t>(static_cast<std::int32_t>(most)) % kKeys;
  }

  std::size_t n_ = 0, rows_ = 0, longest_ = 0;
  Vec3Of<float> first_{}, step_{}, reach_{};
  alignas(64) float i_[kMaxRows], j_[kMaxRows], key_[kMaxRows];
  alignas(64) float low_[kMaxRows], high_[kMaxRows];  // of each row; none is left where low > high
};

}  // namespace dmoscope::volumes
