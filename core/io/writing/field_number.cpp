#include "core/io/writing/field_number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace dmoscope {
namespace {

/// A positive number as its digits, d.ddd times ten to a power.
struct Digits {
  std::string digits;  // digits; the first is not 0, unless it is the only one
  int power = 0;
};

/// The digits of `text`, a number in the scientific notation of to_chars, without a sign.
Digits digits_of(std::string_view text) {
  Digits result;
  const std::size_t e = text.find('e');
  for (const char c : text.substr(0, e)) {
    if (c != '.') result.digits += c;
  }
  while (result.digits.size() > 1 && result.digits.back() == '0') result.digits.pop_back();
  std::string_view power = text.substr(e + 1);
  if (power.starts_with('+')) power.remove_prefix(1);
  std::from_chars(power.data(), power.data() + power.size(), result.power);
  return result;
}

/// The number in plain notation: 123.45, or 0.0123 (or .0123 to save a character).
std::string plain(const Digits& number, bool leading_zero) {
  constexpr int kMost = 32;  // longer ones fit in no field
  if (number.power > kMost || number.power < -kMost) return std::string(2 * kMost, '0');
  if (number.power < 0) {
    return (leading_zero ? "0." : ".") + std::string(static_cast<std::size_t>(-number.power - 1), '0') + number.digits;
  }
  const auto whole = static_cast<std::size_t>(number.power) + 1;
  if (number.digits.size() <= whole) return number.digits + std::string(whole - number.digits.size(), '0') + ".";
  return number.digits.substr(0, whole) + "." + number.digits.substr(whole);
}

std::string scientific(const Digits& number, ExponentStyle style) {
  std::string text = number.digits.substr(0, 1) + "." + number.digits.substr(1);
  if (style == ExponentStyle::Letter) text += 'e';
  if (number.power >= 0 && style == ExponentStyle::Sign) text += '+';
  return text + std::to_string(number.power);
}

double value_of(const Digits& number) {
  const std::string text = scientific(number, ExponentStyle::Letter);
  double value = HUGE_VAL;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? value : HUGE_VAL;
}

}  // namespace

FieldNumber number_in_field(double value, std::size_t width, ExponentStyle style) {
  constexpr int kDigits = 17;  // digits that distinguish every double
  const bool negative = std::signbit(value);
  const double size = std::abs(value);
  std::array<char, 64> buffer{};
  if (const auto most = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value); most.ec == std::errc()) {
    const std::string_view text(buffer.data(), static_cast<std::size_t>(most.ptr - buffer.data()));
    if (text.size() <= width && text.find('.') != std::string_view::npos && text.find('e') == std::string_view::npos) {
      return {std::string(text), value};
    }
  }
  for (int digits = kDigits + 1; digits > 0; --digits) {
    // Tries the shortest text that is exactly this double, then fewer and fewer digits.
    const auto written = digits > kDigits
                             ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), size, std::chars_format::scientific)
                             : std::to_chars(buffer.data(), buffer.data() + buffer.size(), size, std::chars_format::scientific, digits - 1);
    const Digits number = digits_of({buffer.data(), static_cast<std::size_t>(written.ptr - buffer.data())});
    const double back = value_of(number);
    if (!std::isfinite(back)) continue;  // for the largest doubles, rounded up
    for (std::string text : {plain(number, true), scientific(number, style), plain(number, false)}) {
      if (negative) text.insert(text.begin(), '-');
      if (text.size() <= width) return {std::move(text), negative ? -back : back};
    }
  }
  return {"0.", 0.0};
}

}  // namespace dmoscope
