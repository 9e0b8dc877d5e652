#include "core/io/nastran/nastran_cards.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {
namespace {

constexpr std::size_t kField = 8;  // width in columns

char capital(char c) noexcept { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// The text before the first comma, or in the first field's columns.
std::string_view first_field(std::string_view line) {
  const std::size_t comma = line.find(',');
  return trimmed(line.substr(0, comma != std::string_view::npos ? comma : std::min(kField, line.find('\t'))));
}

bool goes_on(std::string_view line) {
  const std::string_view first = first_field(line);
  return first.empty() || first.front() == '+' || first.front() == '*';
}

}  // namespace

void NastranCards::seek(std::size_t offset, std::size_t line) {
  lines_.seek(offset, line);
  held_ = false;
}

bool NastranCards::next_line() {
  while (lines_.next()) {
    line_ = lines_.line().substr(0, lines_.line().find('$'));
    if (!trimmed(line_).empty()) {
      line_begin_ = lines_.begin();
      return true;
    }
    if (line_.size() != lines_.line().size() && on_comment) on_comment(lines_.line());
    passed_over_ = true;
  }
  return false;
}

bool NastranCards::next() {
  if (!held_ && !next_line()) return false;
  held_ = false;
  begin_ = line_begin_;
  end_ = lines_.end();
  number_ = lines_.number();
  interrupted_ = false;
  fields_.clear();
  expanded_.clear();
  name_.clear();
  if (goes_on(line_)) lines_.fail("a line that goes on with a card, but there is none before it");
  for (const char c : first_field(line_)) name_ += capital(c);
  const std::size_t star = name_.find('*');
  if (star != std::string::npos && star + 1 != name_.size()) lines_.fail("repeated cards (*) are not read: write every card out");
  while (name_.ends_with('*') || name_.ends_with(' ')) name_.pop_back();
  if (name_.empty() || name_.front() < 'A' || name_.front() > 'Z') {
    lines_.fail(fmt::format("expected a card such as GRID, got {}", quote_token(trimmed(line_))));
  }
  if (name_ == "ENDDATA") return false;
  take_line(line_);
  passed_over_ = false;
  while (next_line()) {
    if (!goes_on(line_)) {
      held_ = true;
      break;
    }
    interrupted_ = interrupted_ || passed_over_;
    take_line(line_);
    end_ = lines_.end();
  }
  return true;
}

void NastranCards::take_line(std::string_view line) {
  if (line.find('\t') != std::string_view::npos && line.find(',') == std::string_view::npos) {
    std::string& wide = expanded_.emplace_back();
    for (const char c : line) wide.append(c == '\t' ? kField - wide.size() % kField : 1, c == '\t' ? ' ' : c);
    line = wide;
  }
  const std::string_view first = first_field(line);
  const bool large = first.starts_with('*') || first.ends_with('*');
  const std::size_t count = large ? 4 : 8;
  const std::size_t whole = (fields_.size() + count - 1) / count * count;
  fields_.resize(whole);
  const std::size_t before = fields_.size();
  if (line.find(',') != std::string_view::npos) {
    line.remove_prefix(line.find(',') + 1);
    for (std::size_t n = 0;; ++n) {
      const std::size_t comma = line.find(',');
      const std::string_view field = trimmed(line.substr(0, comma));
      if (n < count) {
        fields_.push_back(field);
      } else if (n > count || !(field.empty() || field.front() == '+' || field.front() == '*')) {
        lines_.fail(fmt::format("a line of a card has {} fields at most", count));
      }
      if (comma == std::string_view::npos) break;
      line.remove_prefix(comma + 1);
    }
  } else {
    const std::size_t width = large ? 2 * kField : kField;
    for (std::size_t n = 0; n < count && kField + n * width < line.size(); ++n) {
      fields_.push_back(trimmed(line.substr(kField + n * width, width)));
    }
  }
  fields_.resize(before + count);
}

double NastranCards::real(std::size_t n, std::string_view what) const {
  const std::string_view text = field(n);
  if (text.empty()) return 0.0;
  std::string number;
  for (const char c : text) {
    const bool exponent = (c == '+' || c == '-') && !number.empty() && number.back() != 'E';
    if (exponent) number += 'E';
    number += capital(c) == 'D' ? 'E' : capital(c);
  }
  try {
    return lines_.real(number, what);
  } catch (const InputError&) {
    fail(fmt::format("expected {}, got {}", what, quote_token(text)));
  }
}

std::int32_t NastranCards::label(std::size_t n, std::string_view what) const {
  if (field(n).empty()) fail(fmt::format("a {} without {}", name_, what));
  try {
    return lines_.label(field(n), what);
  } catch (const InputError&) {
    fail(fmt::format("expected {}, got {}", what, quote_token(field(n))));
  }
}

int NastranCards::number_or_zero(std::size_t n, std::string_view what) const {
  return field(n).empty() || field(n) == "0" ? 0 : label(n, what);
}

void NastranCards::fail(const std::string& what) const { lines_.fail_on(number_, what); }

}  // namespace dmoscope
