#include "core/formula/formula_error.h"

#include <fmt/format.h>

namespace dmoscope {

namespace {
std::string sentence(FormulaPlace place, const std::string& what) {
  const std::string line = place.line > 1 ? fmt::format("line {}, ", place.line) : std::string();
  return fmt::format("formula, {}column {}: {}", line, place.column, what);
}
}  // namespace

FormulaError::FormulaError(FormulaPlace place, const std::string& what) : UsageError(sentence(place, what)), place_(place), reason_(what) {}

}  // namespace dmoscope
