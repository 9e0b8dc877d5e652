#pragma once
// Numbers as a person reads them.

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace dmoscope {

/// A finite number in four significant digits, those that are 0 too, so that a column of them lines up: "0.7000", "4728", "1.235e+06".
[[nodiscard]] inline std::string four_digits(double value) {
  if (value == 0.0) return "0.000";
  // From the thousands on the four digits need no point, after which fmt would put a 0 that is not known.
  std::string text = fmt::format("{:#.4g}", value);
  return text.find('e') == std::string::npos && std::abs(value) >= 999.95 ? fmt::format("{:.4g}", value) : text;
}

}  // namespace dmoscope
