#pragma once
// The table of metrics: what the window, the command line and the man page know of them.
// The formulas themselves are in formulas.h.

#include <span>
#include <string_view>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// q(element): 1 for the ideal element, <= 0 for an inverted one (mean-ratio-area cannot see a concave corner).
enum class Metric : std::uint8_t { MeanRatio, MeanRatioArea, RadiusRatio, MinAngle, MaxAngle, Rectangularity, ScaledJacobian, AspectRatio };
inline constexpr std::size_t kMetricCount = 8;

struct MetricInfo {
  Metric metric;
  std::string_view name;     // "mean-ratio"
  std::string_view title;    // "Mean ratio"
  bool triangles;            // defined for triangles
  bool quadrilaterals;       // defined for quadrilaterals
  double lowest, highest;    // range, inverted elements included
  double acceptable;         // elements at or above are usually fine for a solver
  std::string_view formula;  // plain text, UTF-8
  std::string_view doc;      // one line: what it measures, source
  [[nodiscard]] bool defined_for(ElementKind kind) const noexcept {
    return kind == ElementKind::Triangle ? triangles : kind == ElementKind::Quadrilateral && quadrilaterals;
  }
};

/// All metrics, in the order of the enumeration.
[[nodiscard]] std::span<const MetricInfo> metric_table();
[[nodiscard]] const MetricInfo& info(Metric metric);
/// Throws UsageError that lists the known names.
[[nodiscard]] Metric parse_metric(std::string_view name);
/// Throws UsageError naming the kind when the mesh has elements for which the metric is not defined.
void require_defined(Metric metric, const Mesh& mesh);

}  // namespace dmoscope
