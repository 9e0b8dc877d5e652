#include "ui/format.h"

#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/base/number_text.h"

namespace dmoscope::ui {

std::string short_number(double value) {
  if (!std::isfinite(value)) return "–";
  return four_digits(value);
}

std::string full_number(double value) {
  if (std::isnan(value)) return "not defined";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string count(std::uint64_t value) {
  const std::string digits = std::to_string(value);
  std::string out;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    if (k > 0 && (digits.size() - k) % 3 == 0) out += ',';
    out += digits[k];
  }
  return out;
}

std::string rate(double value) {
  if (!std::isfinite(value)) return "–";
  if (value >= 1e9) return fmt::format("{:.3g} G", value / 1e9);
  if (value >= 1e6) return fmt::format("{:.3g} M", value / 1e6);
  if (value >= 1e3) return fmt::format("{:.3g} k", value / 1e3);
  return fmt::format("{:.3g} ", value);
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return "–";
  if (seconds >= 100.0) return fmt::format("{:.0f} s", seconds);
  if (seconds >= 1.0) return fmt::format("{:.3g} s", seconds);
  if (seconds >= 1e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} µs", seconds * 1e6);
}

std::string counted(std::uint64_t value, const char* one, const char* many) { return count(value) + " " + (value == 1 ? one : many); }

}  // namespace dmoscope::ui
