#pragma once
// Numbers as text for people.

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace dmoscope {

/// A finite number with four significant digits, trailing zeros included, so that a column of them lines up: "0.7000", "4728", "1.235e+06".
[[nodiscard]] inline std::string four_digits(double value) {
  if (value == 0.0) return "0.000";
  // Numbers from 1000 on need no decimal point for four digits; fmt would add one and a zero that is not significant.
  std::string text = fmt::format("{:#.4g}", value);
  return text.find('e') == std::string::npos && std::abs(value) >= 999.95 ? fmt::format("{:.4g}", value) : text;
}

/// A count with thousands separators: "1,334,112".
[[nodiscard]] inline std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t left = text.size(); left > 3;) text.insert(left -= 3, 1, ',');
  return text;
}

/// A count with its noun: "1 vertex", "8,429 vertices".
[[nodiscard]] inline std::string counted(std::uint64_t value, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", grouped(value), value == 1 ? one : many);
}

/// Three digits and an SI prefix, to be followed by a unit: "1.61 M", "73.4 k", "12 ".
[[nodiscard]] inline std::string with_prefix(double value) {
  if (value >= 1e9) return fmt::format("{:.3g} G", value / 1e9);
  if (value >= 1e6) return fmt::format("{:.3g} M", value / 1e6);
  if (value >= 1e3) return fmt::format("{:.3g} k", value / 1e3);
  return fmt::format("{:.3g} ", value);
}

}  // namespace dmoscope
