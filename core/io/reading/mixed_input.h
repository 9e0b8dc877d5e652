#pragma once
// Cursor over a file that mixes words and binary blocks (VTK, PLY, STL), with a tokenizer for the words. Errors name a line in text, and a
// byte offset after the first binary block.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/io/reading/source_file.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

class MixedInput {
 public:
  /// Begins at the file's begin. `source` must outlive this.
  MixedInput(const SourceFile& source, Progress& progress);

  /// Whether only white space is left.
  [[nodiscard]] bool at_end() { return text_.at_end(); }
  /// Takes the next word, on whatever line. Throws InputError naming `what` at the end of the file.
  std::string_view word(std::string_view what);
  /// The next word, without taking it; empty at the end of the file.
  [[nodiscard]] std::string_view peek_word();
  /// Takes the next word of the current line; empty if the line has no more.
  std::string_view word_on_line();
  /// Whether the current line has no more words.
  [[nodiscard]] bool line_over() { return !text_.more_on_line(); }
  /// Takes the rest of the current line with its end; returns it without surrounding white space.
  std::string_view rest_of_line();
  /// Takes a number, which may be infinite or NaN. Throws InputError naming `what`.
  double number(std::string_view what);
  /// Takes a finite number. Throws InputError.
  double coordinate();
  std::int64_t integer(std::string_view what);
  /// Takes an integer that this character may follow without a blank. Throws InputError.
  std::int64_t integer_before(char next, std::string_view what);
  /// Takes a count: not negative, and with at least `bytes_each` bytes left in the file for each. Throws InputError.
  std::size_t count(std::string_view what, double bytes_each);
  /// Throws InputError if fewer than n * bytes_each bytes are left.
  void need(std::size_t n, double bytes_each, std::string_view what) const;
  /// Takes the next n bytes. Throws InputError if the file ends before.
  std::string_view block(std::size_t n, std::string_view what);

  [[nodiscard]] std::size_t offset() const noexcept { return text_.offset(); }
  /// Offset of the word or block taken last.
  [[nodiscard]] std::size_t token() const noexcept { return token_; }
  [[nodiscard]] std::size_t left() const noexcept { return text_.remaining(); }
  /// Throws InputError that points at the word or block taken last.
  [[noreturn]] void fail(const std::string& what) const { fail_at(token_, what); }
  /// Throws InputError that points at a place in the file.
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const;

 private:
  [[noreturn]] void fail_end(std::string_view what) const;
  template <class Parse>
  auto parsed(Parse&& parse);

  std::string file_;
  Progress* progress_;
  Tokenizer text_;
  std::size_t token_ = 0;
  std::size_t binary_from_ = static_cast<std::size_t>(-1);
};

}  // namespace dmoscope
