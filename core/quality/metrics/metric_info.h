#pragma once
// The names of the built-in metrics, and what is known of each.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/mesh/kind_set.h"

namespace dmoscope {

/// q(element): 1 for the ideal element, <= 0 for an inverted one (mean-ratio-area cannot see a concave corner). Besides these, metrics that
/// are defined while the program runs, by formulas and targets, have numbers of their own: see core/quality/defined_metric.h.
enum class Metric : std::uint32_t {
  MeanRatio,
  MeanRatioArea,
  RadiusRatio,
  MinAngle,
  MaxAngle,
  Rectangularity,
  ScaledJacobian,
  AspectRatio,
  Condition
};
inline constexpr std::size_t kMetricCount = 9;

[[nodiscard]] constexpr bool is_built_in(Metric metric) { return static_cast<std::size_t>(metric) < kMetricCount; }

struct MetricInfo {
  Metric metric;
  std::string_view name;     // "mean-ratio"
  std::string_view title;    // "Mean ratio"
  double lowest, highest;    // range, inverted elements included
  double acceptable;         // elements at or above are usually fine for a solver
  std::string_view formula;  // plain text, UTF-8
  std::string_view doc;      // one line: what it measures, source
  KindSet kinds{};           // that it is defined for
  [[nodiscard]] bool defined_for(ElementKind kind) const noexcept { return contains(kinds, kind); }
};

}  // namespace dmoscope
