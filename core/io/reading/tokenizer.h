#pragma once
// Tokenizer over the bytes of a text file, for every text format: blanks, line ends, comments, numbers, and errors with a line.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/base/vec.h"

namespace dmoscope {

/// Separators of tokens in a text format. Blanks are space, tab, vertical tab and form feed; a line ends with LF, CR LF or CR.
struct TextSyntax {
  char comment = '\0';                 // begins a comment up to the end of the line; 0: the format has none
  bool comma_is_blank = false;         // commas separate, too, as in Fortran's list-directed input
  bool backslash_joins_lines = false;  // a backslash right before a line end makes both of them a blank (OBJ)
  bool free_form = false;              // read_*() continue on the next line at the end of theirs; otherwise that is an error
};

/// Goes through a text once. Nothing is copied: tokens are views of the text, which must outlive them. All errors are InputError with the
/// file and the line of the token.
class Tokenizer {
 public:
  /// Begins at the begin of `text`; `file`: name in errors.
  Tokenizer(std::string_view text, std::string file, TextSyntax syntax, Progress& progress);

  /// Tokenizer of a part of the text: from `begin`, the begin of a line, which it counts as the first, to byte `end`.
  [[nodiscard]] Tokenizer over(std::size_t begin, std::size_t end, Progress& progress) const {
    Tokenizer part(text_.substr(0, end), file_, syntax_, progress);
    part.seek(begin, 1);
    return part;
  }

  /// Line, from 1, of the token read last (or of the place where the next one was searched).
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  /// Byte offset of the next character.
  [[nodiscard]] std::size_t offset() const noexcept { return position_; }
  /// Byte offset of a token from this tokenizer.
  [[nodiscard]] std::size_t offset_of(std::string_view token) const noexcept {
    return static_cast<std::size_t>(token.data() - text_.data());
  }
  /// Line of a byte, from 1, counted from the begin (for errors that are found late).
  [[nodiscard]] std::size_t line_at(std::size_t offset) const noexcept;
  [[nodiscard]] std::size_t remaining() const noexcept { return text_.size() - position_; }
  [[nodiscard]] std::string_view text() const noexcept { return text_; }
  /// Continues at byte `offset`; from then on line() is wrong unless the caller gives the line of that byte.
  void seek(std::size_t offset, std::size_t line = 0) noexcept {
    position_ = offset;
    line_ = line;
  }

  /// Skips blanks, comments and line ends; true if no token is left in the file. The next token is the first of its line if end_line() was
  /// called before.
  [[nodiscard]] bool at_end() {
    skip<true>();
    return position_ == text_.size();
  }
  /// Skips blanks and a comment; true if a token is left on this line.
  [[nodiscard]] bool more_on_line() {
    skip<false>();
    return position_ < text_.size() && kind_[byte(position_)] != kLineEnd;
  }
  /// Takes the next token of this line, empty if there is none.
  [[nodiscard]] std::string_view token_on_line() {
    skip<false>();
    return take();
  }
  /// Takes the next token of the file, on whatever line, empty if there is none.
  [[nodiscard]] std::string_view token() {
    skip<true>();
    return take();
  }
  /// Skips the rest of this line, with its end.
  void end_line() {
    if (position_ < text_.size() && text_[position_] == '\n') {
      step_over_line_end();
    } else {
      (void)rest_of_line();
    }
  }
  /// Skips a line end behind `thing`, and a comment before it. Throws InputError for further tokens: one number too many means that others
  /// are in wrong places.
  void end_line_of(std::string_view thing);
  /// Skips the rest of the line behind `thing`, which may be a remark. Throws InputError if it begins with a number.
  void end_numbers_of(std::string_view thing);
  /// Takes the rest of this line with comments and blanks, without the line end; goes to the next line.
  std::string_view rest_of_line();

  /// Reports the progress, throws Cancelled. Reading tokens does so regularly.
  void report();

  // In the following functions `what` names the value expected, for the error: "x coordinate", "number of vertices".

  /// Takes the next token (see TextSyntax::free_form). Throws InputError if there is none.
  std::string_view read_token(std::string_view what);
  /// Takes the next token (see TextSyntax::free_form) if it is a finite number in C's notation, without a leading +, as most are. `begin`
  /// is its offset. False: only blanks were skipped; read_token() takes the token, whatever it is.
  [[nodiscard]] bool take_double(double& value, std::size_t& begin);
  /// Takes the next token if it is a whole number of at most 18 digits. `begin` is its offset. False: only blanks were skipped.
  [[nodiscard]] bool take_integer(std::int64_t& value, std::size_t& begin);
  /// Takes a finite number as the nearest double: a leading + and Fortran's D exponent are understood, nan and inf refused.
  double read_double(std::string_view what);
  std::int64_t read_integer(std::string_view what);
  /// Takes x, y and, if there are three components, z. `place` gets the offset of x.
  Vec3 read_point(int components, std::size_t& place);
  /// Takes an index of one of `count` things called `plural` ("vertices"), counted from `base` (0 or 1) in the file. Returns it from 0.
  Index read_index(std::string_view what, std::size_t count, std::string_view plural, std::int64_t base = 0);
  /// Takes a count of things that follow: not negative, below 2^32 - 1, and so small that `bytes_each` for each fit in the bytes left (so
  /// that a wrong count never allocates more than the file's size justifies).
  std::size_t read_count(std::string_view what, std::size_t bytes_each);
  /// Checks a count that was read otherwise, like read_count().
  std::size_t check_count(std::int64_t count, std::string_view what, std::size_t bytes_each) const;
  /// Parses a token that was taken otherwise, like read_double().
  [[nodiscard]] double parse_double(std::string_view token, std::string_view what) const;
  [[nodiscard]] std::int64_t parse_integer(std::string_view token, std::string_view what) const;

  /// Throws InputError at line().
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws InputError at a given line.
  [[noreturn]] void fail_at(std::size_t line, const std::string& what) const { throw InputError(file_, line, what); }
  /// Throws InputError at the last line: the file ends before `what`.
  [[noreturn]] void fail_at_end(std::string_view what) const;

 private:
  enum Kind : std::uint8_t { kOther, kBlank, kLineEnd, kComment, kJoin };

  [[nodiscard]] std::size_t byte(std::size_t position) const noexcept { return static_cast<unsigned char>(text_[position]); }
  /// Whether a line end follows right after the backslash at `position`.
  [[nodiscard]] bool joins(std::size_t position) const noexcept {
    return position + 1 < text_.size() && kind_[byte(position + 1)] == kLineEnd;
  }
  void step_over_line_end() noexcept {
    if (text_[position_] == '\r' && position_ + 1 < text_.size() && text_[position_ + 1] == '\n') ++position_;
    ++position_;
    ++line_;
  }
  void skip_to_line_end() noexcept {
    while (position_ < text_.size() && kind_[byte(position_)] != kLineEnd) ++position_;
  }
  void skip_to_token() {
    if (syntax_.free_form) {
      skip<true>();
    } else {
      skip<false>();
    }
  }
  /// Whether a token certainly ends before the character at `at`.
  [[nodiscard]] bool ends_token(const char* at) const noexcept {
    if (at == text_.data() + text_.size()) return true;
    const std::uint8_t kind = kind_[static_cast<unsigned char>(*at)];
    return kind != kOther && kind != kJoin;
  }
  template <bool kAcrossLines>
  void skip() {
    if (position_ >= next_report_) report();
    for (; position_ < text_.size();) {
      const std::uint8_t kind = kind_[byte(position_)];
      if (kind == kOther) return;
      if (kind == kBlank) {
        ++position_;
      } else if (kind == kComment) {
        skip_to_line_end();
      } else if (kind == kLineEnd) {
        if constexpr (!kAcrossLines) return;
        step_over_line_end();
      } else {  // kJoin
        if (!joins(position_)) return;
        ++position_;
        step_over_line_end();
      }
    }
  }
  /// Takes the token that begins here, empty at a line end or the end of the file.
  std::string_view take() noexcept {
    const std::size_t begin = position_;
    for (; position_ < text_.size(); ++position_) {
      const std::uint8_t kind = kind_[byte(position_)];
      if (kind != kOther && !(kind == kJoin && !joins(position_))) break;
    }
    return text_.substr(begin, position_ - begin);
  }
  std::string_view text_;
  std::string file_;
  TextSyntax syntax_;
  Progress* progress_;
  std::array<std::uint8_t, 256> kind_{};
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::size_t next_report_ = 0;
};

/// A token for an error message: in quotes, cut if long, unprintable bytes as \xHH.
[[nodiscard]] std::string quote_token(std::string_view token);

/// A line without the blanks at both its ends.
[[nodiscard]] std::string_view trimmed(std::string_view line) noexcept;

/// Whether two words agree except for the case of their letters (ASCII).
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b) noexcept;

/// The words of a line between blanks and tabs, at most `most`.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line, std::size_t most = std::string_view::npos);

/// Whether a list of words with blanks between them has one for which is(word) holds.
template <class Is>
[[nodiscard]] bool any_word(std::string_view list, const Is& is) {
  for (std::size_t at = 0; at < list.size();) {
    const std::string_view word = list.substr(at, list.find(' ', at) - at);
    if (is(word)) return true;
    at += word.size() + 1;
  }
  return false;
}

/// A text without the double quotes around it, if it has them.
[[nodiscard]] std::string_view unquoted(std::string_view text) noexcept;

/// A text with its letters (ASCII) in capitals.
[[nodiscard]] std::string in_capitals(std::string_view text);

/// Takes the first line, without its end, from a text that is not empty.
std::string_view take_line(std::string_view& text) noexcept;

/// The infinity or NaN that a word says, in whatever case; none if it says no such number.
[[nodiscard]] std::optional<double> not_finite(std::string_view word);

/// Takes the next number, which may be infinite or NaN. Throws InputError if there is none.
[[nodiscard]] double any_double(Tokenizer& tokens);

}  // namespace dmoscope
