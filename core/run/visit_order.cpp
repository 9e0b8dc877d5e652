#include "core/run/visit_order.h"

#include <fmt/format.h>

#include "core/base/words.h"

namespace dmoscope {

std::string to_text(const VisitOrder& order) { return order.seed ? fmt::format("shuffle:{}", *order.seed) : "natural"; }

VisitOrder parse_order(std::string_view word) {
  constexpr std::string_view prefix = "shuffle:";
  if (word == "natural") return {};
  if (word.starts_with(prefix)) return {to_count(std::string(word.substr(prefix.size())))};
  throw WrongArguments(fmt::format("'{}' is not an order: choose natural or shuffle:SEED", word));
}

}  // namespace dmoscope
