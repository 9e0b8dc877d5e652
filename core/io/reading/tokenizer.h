#pragma once
// One tokenizer over the bytes of a text file, for every text format: blanks, line ends, comments, numbers, and errors with a line.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/base/vec.h"

namespace dmoscope {

/// What is not a token in a text format. Blank are space, tab, vertical tab and form feed; a line ends with LF, CR LF or CR.
struct TextSyntax {
  char comment = '\0';                 // from here to the end of the line is a comment; 0: the format has none
  bool comma_is_blank = false;         // Fortran's list-directed input separates with commas as well
  bool backslash_joins_lines = false;  // a backslash right before a line end makes both of them a blank (OBJ)
  bool free_form = false;              // read_*() go on to the next line when theirs is over; otherwise that is an error
};

/// Walks through a text once. Nothing is copied: tokens are views of the text, which must outlive them.
/// All errors are InputError with the file and the line of the token in question.
class Tokenizer {
 public:
  /// `text` is read from its begin; `file` is what errors call it.
  Tokenizer(std::string_view text, std::string file, TextSyntax syntax, Progress& progress);

  /// One that ends at byte `end` of the same text and begins at `begin`, the begin of a line, which it counts as the first.
  [[nodiscard]] Tokenizer over(std::size_t begin, std::size_t end, Progress& progress) const {
    Tokenizer part(text_.substr(0, end), file_, syntax_, progress);
    part.seek(begin, 1);
    return part;
  }

  /// 1-based line of the token read last (or of the place where the next one was looked for).
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  /// Byte offset of the next character to be looked at.
  [[nodiscard]] std::size_t offset() const noexcept { return position_; }
  /// Byte offset of a token that this tokenizer returned.
  [[nodiscard]] std::size_t offset_of(std::string_view token) const noexcept {
    return static_cast<std::size_t>(token.data() - text_.data());
  }
  /// 1-based line of a byte, counted anew from the begin (for errors that are found late).
  [[nodiscard]] std::size_t line_at(std::size_t offset) const noexcept;
  [[nodiscard]] std::size_t remaining() const noexcept { return text_.size() - position_; }
  [[nodiscard]] std::string_view text() const noexcept { return text_; }
  /// Goes on at byte `offset`; from then on line() is wrong unless the caller gives the line of that byte.
  void seek(std::size_t offset, std::size_t line = 0) noexcept {
    position_ = offset;
    line_ = line;
  }

  /// Skips blanks, comments and line ends; true if no token is left in the file. The next token is then the first of its line
  /// if end_line() came before.
  [[nodiscard]] bool at_end() {
    skip<true>();
    return position_ == text_.size();
  }
  /// Skips blanks and a comment; true if a token is left on this line.
  [[nodiscard]] bool more_on_line() {
    skip<false>();
    return position_ < text_.size() && kind_[byte(position_)] != kLineEnd;
  }
  /// The next token of this line, empty if there is none.
  [[nodiscard]] std::string_view token_on_line() {
    skip<false>();
    return take();
  }
  /// The next token of the file, on whatever line, empty if there is none.
  [[nodiscard]] std::string_view token() {
    skip<true>();
    return take();
  }
  /// Skips what is left of this line, its end included.
  void end_line() {
    if (position_ < text_.size() && text_[position_] == '\n') {
      step_over_line_end();
    } else {
      (void)rest_of_line();
    }
  }
  /// The same, but nothing else may be left than a comment: a number too many means that others stand where they do not belong.
  void end_line_of(std::string_view thing);
  /// The same where a remark may follow: it begins with no number.
  void end_numbers_of(std::string_view thing);
  /// What is left of this line as it stands, comments and blanks included, without the line end; goes on to the next line.
  std::string_view rest_of_line();

  /// Tells the progress, throws Cancelled. Done on the way as well.
  void report();

  // In what follows `what` names the thing expected, for the error: "x coordinate", "number of vertices".

  /// The next token (see TextSyntax::free_form); it is an error if there is none.
  std::string_view read_token(std::string_view what);
  /// The next token (see TextSyntax::free_form) if it is a finite number in C's own way of writing, without a + before it: most are.
  /// `begin` is its offset. False: nothing but blanks were passed over; read_token() gives whatever stands there.
  [[nodiscard]] bool take_double(double& value, std::size_t& begin);
  /// The same for a whole number of at most 18 digits.
  [[nodiscard]] bool take_integer(std::int64_t& value, std::size_t& begin);
  /// A finite double, the nearest to the decimal number: a leading + and Fortran's D exponent are understood, nan and inf refused.
  double read_double(std::string_view what);
  std::int64_t read_integer(std::string_view what);
  /// An index of one of `count` things called `plural` ("vertices"), counted from `base` (0 or 1) in the file. Returns it from 0.
  Index read_index(std::string_view what, std::size_t count, std::string_view plural, std::int64_t base = 0);
  /// How many of something follow: not negative, below 2^32 - 1, and few enough that `bytes_each` a piece fit in the bytes left
  /// (so that a wrong count never makes us allocate more than the file is worth).
  std::size_t read_count(std::string_view what, std::size_t bytes_each);
  /// The same check for a count that was had another way.
  std::size_t check_count(std::int64_t count, std::string_view what, std::size_t bytes_each) const;
  /// The same parsing for a token that was had another way.
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
  /// Is there a line end right after the backslash at `position`?
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
  /// Does a token end before the character at `at`, for certain?
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
  /// The token that begins here, empty at a line end or the end of the file.
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

/// A token as an error message shows it: in quotes, cut when long, unprintable bytes as \xHH.
[[nodiscard]] std::string quote_token(std::string_view token);

/// A line without the blanks at both its ends.
[[nodiscard]] std::string_view trimmed(std::string_view line) noexcept;

/// Do two words agree but for the case of their letters (ASCII)?
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b) noexcept;

/// The next number, which may be infinite or NaN. Throws InputError where there is none.
[[nodiscard]] double any_double(Tokenizer& tokens);

}  // namespace dmoscope
