#include "core/io/gmsh/gmsh_input.h"

#include <utility>

#include <fmt/format.h>

namespace dmoscope {

int GmshInput::whole(std::string_view what) {
  if (binary) return int_at(words.block(sizeof(std::int32_t), what).data());
  const std::int64_t value = words.integer(what);
  if (!std::in_range<int>(value)) words.fail(fmt::format("{} is too large: {}", what, value));
  return static_cast<int>(value);
}

std::int64_t GmshInput::size(std::string_view what) {
  return any_count(binary ? size_at(words.block(sizeof(std::int64_t), what).data()) : words.integer(what), what);
}

std::int64_t GmshInput::any_count(std::int64_t n, std::string_view what) const {
  if (n < 0) words.fail(fmt::format("{} is negative or too large: {}", what, n));
  return n;
}

double GmshInput::real(std::string_view what) { return binary ? real_at(words.block(sizeof(double), what).data()) : words.number(what); }

std::size_t GmshInput::count(std::string_view what, double text, double bytes) {
  const auto n = static_cast<std::size_t>(size(what));
  words.need(n, binary ? bytes : text, what);
  return n;
}

}  // namespace dmoscope
