#include "app/common/text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/common/console.h"
#include "core/quality/defined_metric.h"
#include "core/quality/metric.h"

namespace dmoscope::app {

std::string brief(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : "-"; }

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

void print_json(const Json& object) {
  // Characters that control a terminal occur in strings alone: ASCII ones are escaped by the dump; the others become \u0085 and the like.
  const std::string text = object.dump(2, ' ', false, Json::error_handler_t::replace);
  std::string escaped;
  std::size_t done = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const bool control = byte(i) == 0xC2 && i + 1 < text.size() && byte(i + 1) < 0xA0;
    if (!control && byte(i) != 0x7F) continue;
    escaped += text.substr(done, i - done) + fmt::format("\\u{:04x}", control ? byte(i + 1) : byte(i));
    i += control ? 1 : 0;
    done = i + 1;
  }
  print_lines(escaped + text.substr(done) + '\n');
}

std::string text_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       std::string_view alignment) {
  // Counts letters of UTF-8, not bytes.
  const auto letters = [](const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  };
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < head.size(); ++i) {
    std::size_t width = letters(head[i]);
    for (const auto& row : rows) width = std::max(width, letters(row[i]));
    widths.push_back(width);
  }
  std::string text;
  const auto add = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string fill(widths[i] - letters(row[i]), ' ');
      line += (i > 0 ? "  " : "") + (alignment[i] == 'r' ? fill + row[i] : row[i] + fill);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  };
  add(head);
  for (const auto& row : rows) add(row);
  return text;
}

std::string shell_line(const std::vector<std::string>& words) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=:,./@%";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

std::string names_of_metrics() {
  return fmt::format(
      "{}, {}; formula:TEXT, or formula:@FILE for one in a file (see dmoscope formula). With @SHAPE behind it: against a target",
      names_of(metric_table()), names_of(named_formulas()));
}

}  // namespace dmoscope::app
