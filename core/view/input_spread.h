#pragma once
// Spread of the qualities of a mesh as it was read, the initial range of colours.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/run/summary.h"

namespace dmoscope {

/// Spread of one metric, without inverted elements and those without a quality.
struct InputSpread {
  static constexpr std::size_t kBins = 1000;  // number of bins of equal width, from 0 to 1

  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  std::uint64_t count = 0;
  std::array<std::uint32_t, kBins> bins{};
  Histogram histogram;  // histogram for plots, with inverted elements

  /// Adds an element that is not inverted. `quality`: NaN is ignored.
  void add(double quality);
  void add(const InputSpread& other);
  /// Least and greatest quality. None if no element has a quality.
  [[nodiscard]] std::optional<std::pair<double, double>> range() const;
  /// Range as above, but without the best 5 % where all others lie in its lower half: few elements must not take most of the colours.
  [[nodiscard]] std::optional<std::pair<double, double>> range_without_tail() const;
  /// Qualities at the percentiles `low` and `high`, accurate to a bin; the extreme ones are exact.
  [[nodiscard]] std::optional<std::pair<double, double>> percentiles(double low, double high) const;
};

/// The range rounded outwards to short numbers. A range so narrow that its colours would show rounding is widened.
[[nodiscard]] std::pair<double, double> tidy_range(std::pair<double, double> range);

}  // namespace dmoscope
