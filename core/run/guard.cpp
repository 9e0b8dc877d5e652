#include "core/run/guard.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/quality/defined_metric.h"

namespace dmoscope {

namespace {
constexpr std::string_view kOff = "off", kInput = "input";
}

std::string to_text(const std::optional<GuardRule>& rule) {
  if (!rule) return std::string(kOff);
  return fmt::format("{}:{}", info(rule->metric).name, rule->floor ? fmt::format("{}", *rule->floor) : std::string(kInput));
}

std::optional<GuardRule> parse_guard(std::string_view text) {
  if (text == kOff) return std::nullopt;
  const std::size_t colon = text.rfind(':');  // formulas have colons of their own
  const std::string_view word = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  double floor = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), floor);
  const bool is_number = error == std::errc{} && end == word.data() + word.size() && std::isfinite(floor);
  if (word != kInput && !is_number)
    throw UsageError(fmt::format("'{}' is no guard: it is METRIC:input, METRIC:VALUE, such as mean-ratio:0.2, or off", text));
  GuardRule rule{parse_metric(text.substr(0, colon)), {}};
  if (word != kInput) rule.floor = floor;
  return rule;
}

}  // namespace dmoscope
