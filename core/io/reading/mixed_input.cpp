#include "core/io/reading/mixed_input.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {
namespace {

bool is_space(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }

constexpr TextSyntax kSyntax{.comment = '\0', .comma_is_blank = false, .backslash_joins_lines = false, .free_form = true};

/// Line of a byte, from 1, for line ends of all three kinds.
std::size_t line_of(std::string_view bytes, std::size_t offset) {
  // Assigns the end of a file to its last line, not to the empty one after the last line end.
  if (offset >= bytes.size()) {
    offset = bytes.size();
    while (offset > 0 && is_space(bytes[offset - 1])) --offset;
  }
  std::size_t line = 1;
  for (std::size_t i = 0; i < offset; ++i) {
    if (bytes[i] == '\n' || (bytes[i] == '\r' && !(i + 1 < bytes.size() && bytes[i + 1] == '\n'))) ++line;
  }
  return line;
}

}  // namespace

MixedInput::MixedInput(const SourceFile& source, Progress& progress)
    : file_(source.path().string()), progress_(&progress), text_(source.bytes(), file_, kSyntax, progress) {}

std::string_view MixedInput::word(std::string_view what) {
  const std::string_view found = text_.token();
  if (found.empty()) fail_end(what);
  token_ = text_.offset_of(found);
  return found;
}

std::string_view MixedInput::peek_word() {
  const std::size_t offset = text_.offset();
  const std::size_t line = text_.line();
  const std::string_view found = text_.token();
  text_.seek(offset, line);
  return found;
}

std::string_view MixedInput::word_on_line() {
  const std::string_view found = text_.token_on_line();
  if (!found.empty()) token_ = text_.offset_of(found);
  return found;
}

std::string_view MixedInput::rest_of_line() {
  std::string_view line = text_.rest_of_line();
  while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  return line;
}

/// Calls the tokenizer's parsing, whose errors have no byte offsets.
template <class Parse>
auto MixedInput::parsed(Parse&& parse) {
  try {
    return parse();
  } catch (const InputError& error) {
    if (token_ < binary_from_) throw;
    const std::string text = error.what();
    fail(text.substr(std::min(text.size(), text.find(": ", file_.size()) + 2)));
  }
}

double MixedInput::number(std::string_view what) {
  if (double value = 0.0; text_.take_double(value, token_)) return value;
  const std::string_view found = word(what);
  if (const std::optional<double> special = not_finite(found)) return *special;
  return parsed([&] { return text_.parse_double(found, what); });
}

double MixedInput::coordinate() {
  if (double value = 0.0; text_.take_double(value, token_)) return value;
  const std::string_view found = word("a coordinate");
  return parsed([&] { return text_.parse_double(found, "a coordinate"); });
}

std::int64_t MixedInput::integer(std::string_view what) {
  if (std::int64_t value = 0; text_.take_integer(value, token_)) return value;
  const std::string_view found = word(what);
  return parsed([&] { return text_.parse_integer(found, what); });
}

std::int64_t MixedInput::integer_before(char next, std::string_view what) {
  const std::string_view found = word(what), number = found.substr(0, found.find(next));
  text_.seek(token_ + number.size(), text_.line());
  return parsed([&] { return text_.parse_integer(number, what); });
}

std::size_t MixedInput::count(std::string_view what, double bytes_each) {
  const std::int64_t n = integer(what);
  if (n < 0) fail(fmt::format("{} is negative: {}", what, n));
  need(static_cast<std::size_t>(n), bytes_each, what);
  return static_cast<std::size_t>(n);
}

void MixedInput::need(std::size_t n, double bytes_each, std::string_view what) const {
  if (n >= kNoIndex) fail(fmt::format("{} is {}: this program can hold {} at most", what, n, kNoIndex - 1));
  // Allows one more byte, since the last word of a text needs no separator after it.
  if (static_cast<double>(n) * bytes_each > static_cast<double>(left()) + 1.0) {
    fail(fmt::format("{} is {}, but only {} bytes of the file are left", what, n, left()));
  }
}

std::string_view MixedInput::block(std::size_t n, std::string_view what) {
  const std::size_t start = text_.offset();
  token_ = start;
  binary_from_ = std::min(binary_from_, start);
  if (n > left()) fail(fmt::format("truncated: the file ends within {}, which takes {} bytes; {} are left", what, n, left()));
  text_.seek(start + n);
  progress_->check();
  progress_->set(static_cast<double>(start) / static_cast<double>(text_.text().size() + 1));
  return text_.text().substr(start, n);
}

void MixedInput::fail_at(std::size_t offset, const std::string& what) const {
  if (offset >= binary_from_) throw InputError(file_, 0, fmt::format("{} (at byte {})", what, offset));
  throw InputError(file_, line_of(text_.text(), offset), what);
}

void MixedInput::fail_end(std::string_view what) const {
  fail_at(text_.text().size(), fmt::format("the file ends where {} is expected", what));
}

}  // namespace dmoscope
