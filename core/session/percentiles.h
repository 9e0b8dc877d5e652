#pragma once
// How the worst hundredth, the worst twentieth and the middle of all elements fare.

#include <limits>

namespace dmoscope {

/// Percentiles of the elements' qualities; NaN where they are not known.
struct Percentiles {
  double p1 = std::numeric_limits<double>::quiet_NaN();
  double p5 = std::numeric_limits<double>::quiet_NaN();
  double p50 = std::numeric_limits<double>::quiet_NaN();
  [[nodiscard]] bool known() const noexcept { return p50 == p50; }
};

}  // namespace dmoscope
