#pragma once
// Grid of candidates from which half-spaces are cut off: the rest is convex, so an interval of each row of candidates. A search that knows
// of each candidate it looks at a half-space without better ones needs to look at few (Levin 1965, Newman 1965: the method of centres of
// gravity; here the middle of the longest row).
//
// Only the kernels' sources include it; see lane_kernel_impl.h for what that asks of the code.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/numeric/pack.h"

namespace dmoscope::volumes {

/// Half-space without a better place: where `at_least` + `slope` . (p - `from`) is negative. at_least has room for rounding.
struct GridCut {
  Vec3Of<float> from, slope;
  float at_least = 0.0F;
};

/// Rows of candidates (i, j, k) of n per axis: row i * n + j. Size: room for n * n rows.
template <std::size_t Size>
struct GridRows {
  static constexpr std::int32_t kKeys = 64 * 64;
  alignas(64) float i[Size], j[Size];
  alignas(64) float key[Size];  // number of the row, and kKeys times its nearness to the middle, 0 to 63

  constexpr void fill(std::size_t n) {
    const float middle = 0.5F * static_cast<float>(n - 1);
    for (std::size_t a = 0, row = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b, ++row) {
        i[row] = static_cast<float>(a);
        j[row] = static_cast<float>(b);
        const float da = i[row] - middle, db = j[row] - middle;
        const auto off_middle = static_cast<std::int32_t>(63.0F * (da * da + db * db) / (2.0F * middle * middle));
        key[row] = static_cast<float>((63 - off_middle) * kKeys + static_cast<std::int32_t>(row));
      }
    }
  }
};

/// Candidates (i, j, k) of n per axis, in row i * n + j, from which half-spaces are cut off. F: pack of floats, a row per slot.
template <class F>
class GridCuts {
 public:
  static constexpr std::size_t kMaxPoints = 64;  // per axis

  explicit GridCuts(std::size_t n) : n_(n), rows_((n * n + kWidth - 1) / kWidth * kWidth) {
    if (n == kUsual) {
      take_rows(kUsualRows);
    } else {
      own_.fill(n);
      for (std::size_t row = n * n; row < rows_; ++row) own_.i[row] = own_.j[row] = own_.key[row] = 0.0F;
      take_rows(own_);
    }
  }
  GridCuts(const GridCuts&) = delete;
  GridCuts& operator=(const GridCuts&) = delete;

  /// Begins with all candidates, at x[i], y[j], z[k].
  void begin(const float* x, const float* y, const float* z) {
    reach_ = {reach_of(x), reach_of(y), reach_of(z)};
    first_ = {x[0], y[0], z[0]};
    const float steps = static_cast<float>(static_cast<std::int32_t>(n_) - 1);
    step_ = {(x[n_ - 1] - x[0]) / steps, (y[n_ - 1] - y[0]) / steps, (z[n_ - 1] - z[0]) / steps};
    for (std::size_t row = 0; row < rows_; row += kWidth) {
      F(0.0F).store_aligned(low_ + row);
      F(0.0F - steps).store_aligned(minus_high_ + row);
    }
    for (std::size_t row = n_ * n_; row < rows_; ++row) drop(row);
    begin_ = 0;
    end_ = rows_;
  }

  /// Cuts a half-space off, and finds the longest row that is left.
  void cut(const GridCut& cut) {
    using scalar::max;
    // Writes the cut at candidate (i, j, k) as base + slope_i * i + slope_j * j + rise * k. A rise of nearly nothing is taken for a little
    // more.
    const float slope_i = cut.slope.x * step_.x, slope_j = cut.slope.y * step_.y, rise = cut.slope.z * step_.z;
    const float steepness = std::fabs(slope_i) + std::fabs(slope_j), n = static_cast<float>(static_cast<std::int32_t>(n_));
    const float least = kLeastRise * steepness, up = std::fabs(rise), steep = up > least ? up : least + kTiny;
    const float reach = std::fabs(cut.slope.x) * reach_.x + std::fabs(cut.slope.y) * reach_.y + std::fabs(cut.slope.z) * reach_.z;
    const float base = cut.at_least + (kRounding * reach + least * n) + cut.slope.x * (first_.x - cut.from.x) +
                       cut.slope.y * (first_.y - cut.from.y) + cut.slope.z * (first_.z - cut.from.z);
    // Keeps those k with k >= -(base + ...) / rise where the cut rises with k, or -k >= (base + ...) / rise where it falls.
    const float per_row = -1.0F / steep, start = base * per_row;
    const float doubt = kRounding * (std::fabs(start) - per_row * steepness * n);
    const F first(start + (kUp - doubt)), along_i(slope_i * per_row), along_j(slope_j * per_row), magic(kMagic);
    float* const side = rise < 0.0F ? minus_high_ : low_;
    const float* const other = rise < 0.0F ? low_ : minus_high_;
    F longest(-1.0F);
    for (std::size_t row = begin_; row < end_; row += kWidth) {
      const F bound = (first + along_i * F::load_aligned(i_ + row)) + along_j * F::load_aligned(j_ + row);
      const F mine = max(F::load_aligned(side + row), (bound + magic) - magic);
      mine.store_aligned(side + row);
      longest = max(longest, key_of(mine, F::load_aligned(other + row), row));
    }
    take_longest(longest);
  }

  /// Looks for the longest row anew.
  void find_longest() {
    using scalar::max;
    F longest(-1.0F);
    for (std::size_t row = begin_; row < end_; row += kWidth)
      longest = max(longest, key_of(F::load_aligned(low_ + row), F::load_aligned(minus_high_ + row), row));
    take_longest(longest);
  }

  [[nodiscard]] bool empty() const { return longest_ < 0; }
  /// Number of the longest row.
  [[nodiscard]] std::size_t row() const { return static_cast<std::size_t>(longest_); }
  [[nodiscard]] std::size_t i() const { return whole(i_[longest_]); }
  [[nodiscard]] std::size_t j() const { return whole(j_[longest_]); }
  [[nodiscard]] std::size_t middle() const { return whole(0.5F * (low_[longest_] - minus_high_[longest_])); }

  [[nodiscard]] bool in_question(std::size_t row, std::size_t k) const {
    const auto place = static_cast<float>(static_cast<std::int32_t>(k));
    return low_[row] <= place && place <= 0.0F - minus_high_[row];
  }
  /// Takes candidate k out of its row where it is at an end of the rest of it, and returns whether it is.
  bool drop_end(std::size_t row, std::size_t k) {
    const auto place = static_cast<float>(static_cast<std::int32_t>(k));
    const bool first = low_[row] == place, last = minus_high_[row] == 0.0F - place;
    if (first) low_[row] += 1.0F;
    if (last) minus_high_[row] += 1.0F;
    return first || last;
  }
  void drop(std::size_t row) { low_[row] = 1.0F - minus_high_[row]; }

  /// Largest coordinates of candidates.
  [[nodiscard]] Vec3Of<float> reach() const { return reach_; }

 private:
  static constexpr std::size_t kWidth = F::size;
  static constexpr std::size_t kMaxRows = kMaxPoints * kMaxPoints + kWidth, kUsual = 8;
  using Rows = GridRows<kMaxRows>;
  static constexpr std::int32_t kKeys = Rows::kKeys;
  static constexpr auto kUsualRows = [] {
    GridRows<kUsual * kUsual> rows{};
    rows.fill(kUsual);
    return rows;
  }();
  static constexpr float kRounding = 1e-6F;   // share of the terms of a cut
  static constexpr float kLeastRise = 1e-4F;  // share of the steepness across rows
  static constexpr float kTiny = 1e-30F;
  static constexpr float kUp = 0.499F;          // rounds up, but for a thousandth
  static constexpr float kMagic = 12582912.0F;  // 1.5 * 2^23: added and taken away it rounds to a whole number

  template <std::size_t Size>
  void take_rows(const GridRows<Size>& rows) {
    i_ = rows.i;
    j_ = rows.j;
    key_ = rows.key;
  }
  [[nodiscard]] static std::size_t whole(float a) { return static_cast<std::size_t>(static_cast<std::int32_t>(a)); }
  [[nodiscard]] float reach_of(const float* axis) const {
    const float first = std::fabs(axis[0]), last = std::fabs(axis[n_ - 1]);
    return first > last ? first : last;
  }
  /// Key of a row: among rows of one length the middle one is taken; the key also tells which row it is. A whole number below 2^24, so it
  /// is exact; negative where nothing is left of the row.
  [[nodiscard]] F key_of(F low, F minus_high, std::size_t row) const {
    return (low + minus_high) * F(static_cast<float>(-64 * kKeys)) + F::load_aligned(key_ + row);
  }
  void take_longest(F keys) {
    alignas(64) float slots[kWidth];
    keys.store_aligned(slots);
    for (std::size_t half = kWidth / 2; half > 0; half /= 2)
      for (std::size_t k = 0; k < half; ++k) slots[k] = slots[k] > slots[k + half] ? slots[k] : slots[k + half];
    const auto longest = static_cast<std::int32_t>(slots[0]);
    longest_ = longest < 0 ? longest : longest % kKeys;
    // Narrows the range of rows: the rest is convex, so packs of rows without any candidate are at both ends.
    while (begin_ < end_ && is_out(begin_)) begin_ += kWidth;
    while (begin_ < end_ && is_out(end_ - kWidth)) end_ -= kWidth;
  }
  [[nodiscard]] bool is_out(std::size_t row) const {
    return !xsimd::any(F::load_aligned(low_ + row) + F::load_aligned(minus_high_ + row) <= F(0.0F));
  }

  std::size_t n_, rows_, begin_ = 0, end_ = 0;  // candidates are left in rows between the last two
  std::int32_t longest_ = -1;
  Vec3Of<float> first_{}, step_{}, reach_{};
  const float *i_, *j_, *key_;                              // see GridRows
  Rows own_;                                                // rows of any grid but the usual one
  alignas(64) float low_[kMaxRows], minus_high_[kMaxRows];  // ends of each row; nothing is left where low > high
};

}  // namespace dmoscope::volumes
