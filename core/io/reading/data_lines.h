#pragma once
// A text file line by line, each cut at its commas: what Abaqus and Nastran files are made of.

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
  /// `source` must outlive this.
  DataLines(const SourceFile& source, Progress& progress)
      : lines_(source.bytes(), source.path().string(), {}, progress), numbers_(source.bytes(), source.path().string(), {}, unwatched_) {}

  /// Goes on to the next line; false if there is none. Throws Cancelled.
  [[nodiscard]] bool next() {
    if (lines_.remaining() == 0) return false;
    begin_ = lines_.offset();
    number_ = lines_.line();
    line_ = lines_.rest_of_line();
    numbers_.seek(begin_, number_);
    return true;
  }
  /// Goes on with the line that begins at byte `offset`, whose number is `line`.
  void seek(std::size_t offset, std::size_t line) noexcept { lines_.seek(offset, line); }
  /// The line as it stands, without its end.
  [[nodiscard]] std::string_view line() const noexcept { return line_; }
  /// 1-based.
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  /// Where the line begins in the file, and where the next one does.
  [[nodiscard]] std::size_t begin() const noexcept { return begin_; }
  [[nodiscard]] std::size_t end() const noexcept { return lines_.offset(); }
  /// Byte offset of a part of the file.
  [[nodiscard]] std::size_t offset_of(std::string_view part) const noexcept { return lines_.offset_of(part); }
  /// What is between the line's commas, without blanks around; empty ones at its end are left out. Valid until it is called again.
  [[nodiscard]] std::span<const std::string_view> fields();
  /// Does the line end with a comma?
  [[nodiscard]] bool ends_with_comma() const noexcept { return trimmed(line_).ends_with(','); }

  // Errors are InputError at this line. `what` names the thing expected.

  [[nodiscard]] double real(std::string_view field, std::string_view what) const { return numbers_.parse_double(field, what); }
  [[nodiscard]] std::int64_t integer(std::string_view field, std::string_view what) const { return numbers_.parse_integer(field, what); }
  /// A number that a thing is called by: from 1 to 2^31 - 1.
  [[nodiscard]] std::int32_t label(std::string_view field, std::string_view what) const;
  [[noreturn]] void fail(const std::string& what) const { numbers_.fail(what); }
  [[noreturn]] void fail_on(std::size_t line, const std::string& what) const { numbers_.fail_at(line, what); }
  /// The line of a byte, counted from the begin.
  [[nodiscard]] std::size_t line_at(std::size_t offset) const noexcept { return numbers_.line_at(offset); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const { numbers_.fail_at(line_at(offset), what); }

 private:
  Progress unwatched_;
  Tokenizer lines_;
  Tokenizer numbers_;  // knows the line that errors point at
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t begin_ = 0;
  std::vector<std::string_view> fields_;
};

}  // namespace dmoscope
