#pragma once
// The names that formulas may use: what each stands for, in order of a manual.

#include <cstdint>
#include <span>
#include <string_view>

namespace dmoscope {

/// Where a name has a value: of the whole element; at each corner; at each edge.
enum class NameScope : std::uint8_t { Element, Corner, Edge };

struct FormulaName {
  std::string_view name;
  NameScope scope;
  bool is_vector;
  int power;  // of a length that it is: an area 2 ...
  std::string_view doc;
};
/// All but those with numbers: p1, l12, ... (see numbered_names()).
[[nodiscard]] std::span<const FormulaName> formula_names();

struct FormulaFunction {
  std::string_view name;
  int least, most;             // arguments
  std::string_view arguments;  // "x, y"
  std::string_view doc;
};
[[nodiscard]] std::span<const FormulaFunction> formula_functions();

}  // namespace dmoscope
