#pragma once
// Numbers, tables and JSON as the subcommands print them.

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/number_text.h"

namespace dmoscope::app {

/// Keeps the order in which keys were given, so that the output reads like its documentation.
using Json = nlohmann::ordered_json;

/// Six significant digits for a person; "-" for infinity and NaN.
[[nodiscard]] std::string brief(double value);
/// A number for JSON: null where it is infinite or NaN.
[[nodiscard]] Json json_number(double value);
/// The one object on standard output.
void print_json(const Json& object);
/// "a, b, c" of the names of a table's rows.
template <class Table>
[[nodiscard]] std::string names_of(const Table& table) {
  std::string names;
  for (const auto& row : table) {
    if (!names.empty()) names += ", ";
    names += row.name;
  }
  return names;
}
/// Those of all metrics that may be named, and how others are written.
[[nodiscard]] std::string names_of_metrics();
/// Lines of cells under a head, each column as wide as its widest cell, two blanks apart. `alignment`: an 'l' or an 'r' a column.
[[nodiscard]] std::string text_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                                     std::string_view alignment);
/// Words as a line that a shell takes apart into the same words.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

}  // namespace dmoscope::app
