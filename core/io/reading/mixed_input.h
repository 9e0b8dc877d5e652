#pragma once
// A cursor over a file that mixes words and binary blocks (VTK, PLY, STL): the tokenizer for the words, and blocks between them. Where
// something is wrong is told as a line while the file is text, and as a byte offset once a binary block was met.

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
  /// `source` must outlive this.
  MixedInput(const SourceFile& source, Progress& progress);

  /// True when only white space is left.
  [[nodiscard]] bool at_end() { return text_.at_end(); }
  /// The next word, on whatever line it stands. Throws InputError naming `what` at the end of the file.
  std::string_view word(std::string_view what);
  /// The next word without taking it; empty at the end of the file.
  [[nodiscard]] std::string_view peek_word();
  /// The next word of the current line; empty when the line has no more.
  std::string_view word_on_line();
  /// True when the current line has no more words.
  [[nodiscard]] bool line_over() { return !text_.more_on_line(); }
  /// What is left of the current line, without surrounding white space; the line's end is taken.
  std::string_view rest_of_line();
  /// A number, which may be infinite or NaN. Throws InputError naming `what`.
  double number(std::string_view what);
  /// A finite number. Throws InputError.
  double coordinate();
  std::int64_t integer(std::string_view what);
  /// A count: not negative, and with at least `bytes_each` bytes left in the file for each. Throws InputError.
  std::size_t count(std::string_view what, double bytes_each);
  /// Throws InputError when fewer than n * bytes_each bytes are left.
  void need(std::size_t n, double bytes_each, std::string_view what) const;
  /// The next n bytes, whatever they are. Throws InputError when the file ends before.
  std::string_view block(std::size_t n, std::string_view what);

  [[nodiscard]] std::size_t offset() const noexcept { return text_.offset(); }
  /// Where the word or block taken last starts.
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
