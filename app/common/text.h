#pragma once
// Numbers, tables and JSON in the form that the subcommands print.

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/number_text.h"

namespace dmoscope::app {

/// JSON that keeps the order of its keys, so that the output reads like its documentation.
using Json = nlohmann::ordered_json;

/// Six significant digits; "-" for infinity and NaN.
[[nodiscard]] std::string brief(double value);
/// A number as JSON: null if it is infinite or NaN.
[[nodiscard]] Json json_number(double value);
/// Prints the one object on standard output.
void print_json(const Json& object);
/// Names of a table's rows: "a, b, c".
template <class Table>
[[nodiscard]] std::string names_of(const Table& table) {
  std::string names;
  for (const auto& row : table) {
    if (!names.empty()) names += ", ";
    names += row.name;
  }
  return names;
}
/// Names of all metrics that may be named, and the form of others.
[[nodiscard]] std::string names_of_metrics();
/// Formats lines of cells under a head, each column as wide as its widest cell, two blanks apart. `alignment`: an 'l' or an 'r' a column.
[[nodiscard]] std::string text_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                                     std::string_view alignment);
/// Quotes words as a line that a shell splits into the same words.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

}  // namespace dmoscope::app
