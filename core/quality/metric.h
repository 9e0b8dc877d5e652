#pragma once
// The table of metrics: what the window, the command line and the man page know of them.
// The formulas themselves are in formulas.h.

#include <span>
#include <string>
#include <string_view>

#include "core/mesh/kind_set.h"
#include "core/mesh/mesh.h"

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
  KindSet kinds;             // that it is defined for
  double lowest, highest;    // range, inverted elements included
  double acceptable;         // elements at or above are usually fine for a solver
  std::string_view formula;  // plain text, UTF-8
  std::string_view doc;      // one line: what it measures, source
  [[nodiscard]] bool defined_for(ElementKind kind) const noexcept { return contains(kinds, kind); }
};

/// Those that are built in, in the order of the enumeration.
[[nodiscard]] std::span<const MetricInfo> metric_table();
/// Of any metric.
[[nodiscard]] const MetricInfo& info(Metric metric);
/// The metric of this name: a built-in one; one of named_formulas(); "formula:TEXT", or "formula:@FILE" for a text in a file; each also
/// with a target, "mean-ratio@layers:input". Throws UsageError that lists the known names or says what is wrong with the formula or target,
/// InputError where the file cannot be read.
[[nodiscard]] Metric parse_metric(std::string_view name);
/// Throws UsageError naming the kind when the mesh has elements for which the metric is not defined.
void require_defined(Metric metric, const Mesh& mesh);
/// Code for one built-in metric was asked to do another: a mistake in the program. Throws std::logic_error.
[[noreturn]] void refuse_defined_metric();

}  // namespace dmoscope
