#pragma once
// What a run keeps from falling, whatever it raises: the least of another metric.

#include <optional>
#include <string>
#include <string_view>

#include "core/quality/metric.h"

namespace dmoscope {

struct GuardRule {
  Metric metric = Metric::MeanRatio;
  std::optional<double> floor{};  // none: the least of the input's elements that can move
  friend bool operator==(const GuardRule&, const GuardRule&) = default;
};

/// "mean-ratio:input", "scaled-jacobian:0.2"; "off" of none.
[[nodiscard]] std::string to_text(const std::optional<GuardRule>& rule);
/// Throws UsageError.
[[nodiscard]] std::optional<GuardRule> parse_guard(std::string_view text);

}  // namespace dmoscope
