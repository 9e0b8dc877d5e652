#pragma once
// The table of metrics: what the window, the command line and the man page know of them.
// The formulas themselves are in formulas.h.

#include <span>
#include <string>
#include <string_view>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// q(element): 1 for the ideal element, <= 0 for an inverted one (mean-ratio-area cannot see a concave corner).
enum class Metric : std::uint8_t {
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

/// A set of kinds of elements: bit k is ElementKind k.
using KindSet = std::uint8_t;
/// "triangles, quadrilaterals and tetrahedra".
[[nodiscard]] std::string words(KindSet kinds);
[[nodiscard]] constexpr KindSet kind_set(ElementKind kind) { return static_cast<KindSet>(1U << static_cast<unsigned>(kind)); }

struct MetricInfo {
  Metric metric;
  std::string_view name;     // "mean-ratio"
  std::string_view title;    // "Mean ratio"
  KindSet kinds;             // that it is defined for
  double lowest, highest;    // range, inverted elements included
  double acceptable;         // elements at or above are usually fine for a solver
  std::string_view formula;  // plain text, UTF-8
  std::string_view doc;      // one line: what it measures, source
  [[nodiscard]] bool defined_for(ElementKind kind) const noexcept { return (kinds & kind_set(kind)) != 0; }
};

/// All metrics, in the order of the enumeration.
[[nodiscard]] std::span<const MetricInfo> metric_table();
[[nodiscard]] const MetricInfo& info(Metric metric);
/// Throws UsageError that lists the known names.
[[nodiscard]] Metric parse_metric(std::string_view name);
/// Throws UsageError naming the kind when the mesh has elements for which the metric is not defined.
void require_defined(Metric metric, const Mesh& mesh);

}  // namespace dmoscope
