#pragma once
// The table of metrics: what the window, the command line and the man page know of them.
// Each is defined in a header of metrics/.

#include <span>
#include <string>
#include <string_view>

#include "core/mesh/mesh.h"
#include "core/quality/metrics/metric_info.h"

namespace dmoscope {

/// The built-in metrics, in the order of the enumeration.
[[nodiscard]] std::span<const MetricInfo> metric_table();
/// Name, range and description of any metric, built in or defined.
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
