#include "core/base/byte_size.h"

#include <charconv>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

std::uint64_t parse_byte_size(std::string_view word) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  std::string unit(end, word.data() + word.size());
  for (char& c : unit) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  constexpr std::string_view kLetters = "kmgt";
  const std::size_t power = unit.empty() ? 0 : kLetters.find(unit.front()) + 1;  // 0 without a known letter, as npos + 1 is 0
  const bool plain = unit.empty() || unit == "b";
  const bool known = plain || (power > 0 && (unit.size() == 1 || unit.substr(1) == "b" || unit.substr(1) == "ib"));
  const unsigned shift = plain ? 0 : 10U * static_cast<unsigned>(power);
  if (error != std::errc{} || !known || value == 0 || value > std::numeric_limits<std::uint64_t>::max() >> shift)
    throw UsageError(fmt::format("'{}' is not an amount of memory, such as 800M or 2G", word));
  return value << shift;
}

}  // namespace dmoscope
