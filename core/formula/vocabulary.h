#pragma once
// Names that formulas may use and their meanings, in the order of the manual.

#include <cstdint>
#include <span>
#include <string_view>

namespace dmoscope {

/// Scope in which a name has a value: the whole element, each corner, or each edge.
enum class NameScope : std::uint8_t { Element, Corner, Edge };

struct FormulaName {
  std::string_view name;
  NameScope scope;
  bool is_vector;
  int power;  // power of a length that it is: 2 for an area ...
  std::string_view doc;
};
/// All names except those with numbers: p1, l12, ... (see numbered_names()).
[[nodiscard]] std::span<const FormulaName> formula_names();

struct FormulaFunction {
  std::string_view name;
  int least, most;             // numbers of arguments
  std::string_view arguments;  // names such as "x, y"
  std::string_view doc;
};
[[nodiscard]] std::span<const FormulaFunction> formula_functions();

}  // namespace dmoscope
