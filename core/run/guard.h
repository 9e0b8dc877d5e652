#pragma once
// Guard of a run: a metric whose least falls no further, whatever else is raised.

#include <optional>
#include <string>
#include <string_view>

#include "core/quality/metric.h"

namespace dmoscope {

struct GuardRule {
  Metric metric = Metric::MeanRatio;
  std::optional<double> floor{};  // none: the least quality of the input's elements that can move
  friend bool operator==(const GuardRule&, const GuardRule&) = default;
};

/// Words of a guard: "mean-ratio:input", "scaled-jacobian:0.2"; "off" for none.
[[nodiscard]] std::string to_text(const std::optional<GuardRule>& rule);
/// Reads the words of to_text(). Throws UsageError.
[[nodiscard]] std::optional<GuardRule> parse_guard(std::string_view text);

}  // namespace dmoscope
