#pragma once
// Metrics that are defined while the program runs: by a formula, by a target, or both. The same words always mean the same metric, and a
// definition never changes; so a metric is a plain number that anybody may keep.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/formula.h"
#include "core/quality/formula_facts.h"
#include "core/quality/metric.h"
#include "core/target/target.h"

namespace dmoscope {

struct DefinedMetric {
  std::string name, title, doc;  // what `info` shows
  std::shared_ptr<const Formula> formula;
  std::optional<Metric> base{};  // the built-in one whose formula it is
  Target target{};
  double acceptable = 0.3;
  FormulaFacts facts{};
  MetricInfo info{};
};

/// The definition of a metric that is not built in.
[[nodiscard]] const DefinedMetric& defined(Metric metric);
/// All metrics that were defined so far, in the order of definition.
[[nodiscard]] std::vector<Metric> defined_metrics();
/// The metric of this name where it is one that is defined: see parse_metric(), which throws what this throws.
[[nodiscard]] std::optional<Metric> define_metric(std::string_view name);

/// A metric with its target replaced; with the ideal target, the metric that it was made of. Throws UsageError.
[[nodiscard]] Metric with_target(Metric metric, const Target& target);
[[nodiscard]] Target target_of(Metric metric);

/// Formulas that have names of their own.
struct NamedFormula {
  std::string_view name, title, formula, doc;
  double acceptable = 0.3;
};
[[nodiscard]] std::span<const NamedFormula> named_formulas();
/// The formula text that computes a built-in metric.
[[nodiscard]] std::string_view formula_of(Metric built_in);

}  // namespace dmoscope
