#include "core/io/reading/data_lines.h"

#include <limits>

#include <fmt/format.h>

namespace dmoscope {

std::span<const std::string_view> DataLines::fields() {
  fields_.clear();
  std::string_view rest = line_;
  for (;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view field = rest.substr(0, comma);
    const std::string_view without = trimmed(field);
    fields_.push_back(without.empty() ? field.substr(0, 0) : without);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  while (!fields_.empty() && fields_.back().empty()) fields_.pop_back();
  return fields_;
}

std::int32_t DataLines::label(std::string_view field, std::string_view what) const {
  const std::int64_t value = integer(field, what);
  if (value < 1) fail(fmt::format("{} {}: numbers count from 1", what, value));
  if (value > std::numeric_limits<std::int32_t>::max()) fail(fmt::format("{} {} is too large", what, value));
  return static_cast<std::int32_t>(value);
}

}  // namespace dmoscope
