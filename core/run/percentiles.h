#pragma once
// Percentiles of quality: the worst hundredth, the worst twentieth and the median of all elements.

#include <limits>
#include <span>
#include <vector>

#include "core/quality/quality.h"

namespace dmoscope {

/// Percentiles of the elements' qualities; NaN where they are not known.
struct Percentiles {
  double p1 = std::numeric_limits<double>::quiet_NaN();
  double p5 = std::numeric_limits<double>::quiet_NaN();
  double p50 = std::numeric_limits<double>::quiet_NaN();
  [[nodiscard]] bool known() const noexcept { return p50 == p50; }
};

/// The qualities that a hundredth, a twentieth and half of the elements are not better than: the smallest ones with so many at or below
/// them. NaN is left out. Reorders `qualities`.
[[nodiscard]] Percentiles percentiles_of(std::vector<double>& qualities);

/// Percentiles of qualities in ascending order, without NaN.
[[nodiscard]] Percentiles percentiles_of_sorted(std::span<const float> qualities);

/// Percentiles of a mesh.
[[nodiscard]] Percentiles compute_percentiles(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                                              ThreadPool* pool);

}  // namespace dmoscope
