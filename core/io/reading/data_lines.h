#pragma once
// Lines of a text file, split at commas, as in Abaqus and Nastran files.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/io/reading/source_file.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

class DataLines {
 public:
  /// Begins before the first line. `source` must outlive this.
  DataLines(const SourceFile& source, Progress& progress)
      : lines_(source.bytes(), source.path().string(), {}, progress), numbers_(source.bytes(), source.path().string(), {}, unwatched_) {}

  /// Goes to the next line; false if there is none. Throws Cancelled.
  [[nodiscard]] bool next() {
    if (lines_.remaining() == 0) return false;
    begin_ = lines_.offset();
    number_ = lines_.line();
    line_ = lines_.rest_of_line();
    numbers_.seek(begin_, number_);
    return true;
  }
  /// Continues with the line that begins at byte `offset`, whose number is `line`.
  void seek(std::size_t offset, std::size_t line) noexcept { lines_.seek(offset, line); }
  /// The whole line, without its end.
  [[nodiscard]] std::string_view line() const noexcept { return line_; }
  /// Number of the line, from 1.
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  /// Offset of the line's begin; the other function has that of the next line.
  [[nodiscard]] std::size_t begin() const noexcept { return begin_; }
  [[nodiscard]] std::size_t end() const noexcept { return lines_.offset(); }
  /// Byte offset in the file of a part of the text.
  [[nodiscard]] std::size_t offset_of(std::string_view part) const noexcept { return lines_.offset_of(part); }
  /// The texts between the line's commas, without blanks around; empty ones at its end are left out. Valid until the next call.
  [[nodiscard]] std::span<const std::string_view> fields();
  /// Whether the line ends with a comma.
  [[nodiscard]] bool ends_with_comma() const noexcept { return trimmed(line_).ends_with(','); }

  // Errors of the following functions are InputError at this line. `what` names the value expected.

  [[nodiscard]] double real(std::string_view field, std::string_view what) const { return numbers_.parse_double(field, what); }
  [[nodiscard]] std::int64_t integer(std::string_view field, std::string_view what) const { return numbers_.parse_integer(field, what); }
  /// The number of a node, element or the like: from 1 to 2^31 - 1.
  [[nodiscard]] std::int32_t label(std::string_view field, std::string_view what) const;
  [[noreturn]] void fail(const std::string& what) const { numbers_.fail(what); }
  [[noreturn]] void fail_on(std::size_t line, const std::string& what) const { numbers_.fail_at(line, what); }
  /// The line of a byte, counted from the begin.
  [[nodiscard]] std::size_t line_at(std::size_t offset) const noexcept { return numbers_.line_at(offset); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const { numbers_.fail_at(line_at(offset), what); }

 private:
  Progress unwatched_;
  Tokenizer lines_;
  Tokenizer numbers_;  // has the line number for errors
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t begin_ = 0;
  std::vector<std::string_view> fields_;
};

}  // namespace dmoscope
