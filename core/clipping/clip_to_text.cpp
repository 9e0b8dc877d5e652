#include "core/clipping/clip_to_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope {
namespace {

/// The finite number that a word is; none for any other word.
std::optional<double> number(std::string_view word) {
  double value = 0.0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The word before `separator`, which is removed from the text with it; all of the text if there is none.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view word = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view() : text.substr(at + 1);
  return word;
}

/// Fraction in a text; NaN if it is none.
double fraction_of(std::string_view rest, bool given) {
  if (!given) return 0.5;
  const auto fraction = number(rest);
  return fraction && *fraction >= 0.0 && *fraction <= 1.0 ? *fraction : std::nan("");
}

std::optional<ClipPlane> across_axis(std::string_view words, Vec3 low, Vec3 high) {
  ClipPlane plane{.on = true};
  std::string_view rest = words;
  std::string_view axis = take(rest, ':');
  if (axis.starts_with('-')) {
    plane.flip = true;
    axis.remove_prefix(1);
  }
  if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z') return std::nullopt;
  const double fraction = fraction_of(rest, words.find(':') != std::string_view::npos);
  if (std::isnan(fraction)) return std::nullopt;
  plane.normal = {axis[0] == 'x' ? 1.0 : 0.0, axis[0] == 'y' ? 1.0 : 0.0, axis[0] == 'z' ? 1.0 : 0.0};
  const double from = dot(plane.normal, low), to = dot(plane.normal, high);
  plane.offset = from + fraction * (to - from);
  return plane;
}

std::optional<ClipPlane> by_numbers(std::string_view words) {
  const auto x = number(take(words, ',')), y = number(take(words, ',')), z = number(take(words, ':')), offset = number(words);
  if (!x || !y || !z || !offset) return std::nullopt;
  const ClipPlane plane{.on = true, .normal = {*x, *y, *z}, .offset = *offset};
  const double size = length(plane.normal);
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;
  return plane;
}

}  // namespace

ClipPlane parse_clip(std::string_view words, Vec3 low, Vec3 high) {
  if (const auto plane = across_axis(words, low, high)) return *plane;
  if (const auto plane = by_numbers(words)) return *plane;
  throw UsageError(
      "clip '" + std::string(words) +
      "': expected x, y, z, -x, -y or -z, with :FRACTION from 0 to 1 or without, or NX,NY,NZ:OFFSET with a normal that is not 0");
}

ClipPlane::Mode parse_clip_mode(std::string_view word) {
  return parse_choice<ClipPlane::Mode>("clip mode", word, std::array<std::string_view, 2>{"crinkle", "cut"});
}

}  // namespace dmoscope
