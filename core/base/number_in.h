#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace dmoscope {

/// The number that a whole word represents; none if it is no Number or out of range.
template <class Number>
[[nodiscard]] std::optional<Number> number_in(std::string_view word) {
  Number value{};
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || stop != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace dmoscope
