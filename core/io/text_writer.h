#pragma once
// Fast buffered output of text and bytes.

#include <charconv>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/io/atomic_file.h"

namespace dmoscope {

/// Collects output and hands it on in large pieces. Call finish() at the end: the destructor writes nothing.
class TextWriter {
 public:
  TextWriter(AtomicFile& file, Progress& progress) : file_(&file), progress_(&progress) { buffer_.reserve(kBufferSize + kLongestNumber); }

  TextWriter& operator<<(std::string_view text) {
    buffer_.append(text);
    flush_if_full();
    return *this;
  }
  TextWriter& operator<<(const char* text) { return *this << std::string_view(text); }
  TextWriter& operator<<(const std::string& text) { return *this << std::string_view(text); }
  TextWriter& operator<<(char c) {
    buffer_.push_back(c);
    flush_if_full();
    return *this;
  }
  /// The shortest decimal number that reads back as the same double.
  TextWriter& operator<<(double value) { return number(value); }
  template <std::integral Integer>
  requires(!std::same_as<Integer, char> && !std::same_as<Integer, bool>) TextWriter& operator<<(Integer value) { return number(value); }
  /// Throws OutputError, Cancelled.
  void finish() {
    file_->write(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kBufferSize = std::size_t{1} << 20;
  static constexpr std::size_t kLongestNumber = 64;

  template <class Number>
  TextWriter& number(Number value) {
    char digits[kLongestNumber];
    const auto result = std::to_chars(digits, digits + kLongestNumber, value);
    buffer_.append(digits, static_cast<std::size_t>(result.ptr - digits));
    flush_if_full();
    return *this;
  }
  void flush_if_full() {
    if (buffer_.size() < kBufferSize) return;
    progress_->check();
    finish();
  }

  AtomicFile* file_;
  Progress* progress_;
  std::string buffer_;
};

}  // namespace dmoscope
