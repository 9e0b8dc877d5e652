#pragma once
// How the qualities of a mesh are spread as it was read: what colours start from.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/run/summary.h"

namespace dmoscope {

/// Of one metric, inverted elements and those without a quality apart.
struct InputSpread {
  static constexpr std::size_t kBins = 1000;  // equally wide, from 0 to 1

  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  std::uint64_t count = 0;
  std::array<std::uint32_t, kBins> bins{};
  Histogram histogram;  // as plots show it, inverted elements and all

  /// `quality`: of an element that is not inverted; NaN is left out.
  void add(double quality);
  void add(const InputSpread& other);
  /// None where no element has a quality.
  [[nodiscard]] std::optional<std::pair<double, double>> range() const;
  /// The qualities that `low` and `high` per cent of the elements are not better than, to a bin; the extreme ones are exact.
  [[nodiscard]] std::optional<std::pair<double, double>> percentiles(double low, double high) const;
};

/// The range rounded outwards, to numbers that can be read at a glance. One so narrow that its colours would tell of rounding is widened.
[[nodiscard]] std::pair<double, double> tidy_range(std::pair<double, double> range);

}  // namespace dmoscope
