#pragma once
// Fast output of text and bytes into memory, and into a file with several threads.

#include <algorithm>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/io/reading/io_context.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope {

/// Output into memory.
class TextBuffer {
 public:
  explicit TextBuffer(std::size_t capacity = 0) : bytes_(std::make_unique_for_overwrite<char[]>(capacity)), capacity_(capacity) {}

  TextBuffer& operator<<(std::string_view text) {
    make_room(text.size());
    std::memcpy(bytes_.get() + size_, text.data(), text.size());
    size_ += text.size();
    return *this;
  }
  TextBuffer& operator<<(const char* text) { return *this << std::string_view(text); }
  TextBuffer& operator<<(const std::string& text) { return *this << std::string_view(text); }
  TextBuffer& operator<<(char c) {
    make_room(1);
    bytes_[size_++] = c;
    return *this;
  }
  /// Appends the shortest decimal number that reads back as the same double.
  TextBuffer& operator<<(double value) { return number(value); }
  template <std::integral Integer>
  requires(!std::same_as<Integer, char> && !std::same_as<Integer, bool>) TextBuffer& operator<<(Integer value) { return number(value); }

  [[nodiscard]] std::string_view text() const noexcept { return {bytes_.get(), size_}; }
  void clear() noexcept { size_ = 0; }

 private:
  template <class Number>
  TextBuffer& number(Number value) {
    constexpr std::size_t kLongestNumber = 64;
    make_room(kLongestNumber);
    char* const begin = bytes_.get() + size_;
    size_ += static_cast<std::size_t>(std::to_chars(begin, begin + kLongestNumber, value).ptr - begin);
    return *this;
  }
  void make_room(std::size_t count) {
    if (capacity_ - size_ < count) grow(size_ + count);
  }
  void grow(std::size_t least);

  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
  std::size_t capacity_;
};

/// Collects output for a file and passes it on in large parts. finish() must be called at the end: the destructor writes nothing. Throws
/// OutputError, Cancelled.
class TextWriter {
 public:
  TextWriter(AtomicFile& file, const IoContext& context) : file_(&file), context_(context), buffer_(kPiece + kPiece / 4) {}

  template <class Thing>
  TextWriter& operator<<(const Thing& thing) {
    buffer_ << thing;
    if (buffer_.text().size() >= kPiece) finish();
    return *this;
  }
  /// Writes bytes without copying them.
  void bytes(std::string_view bytes);
  /// Calls format(part, first, last) for chunks of at most `grain` of `count` items, on the context's threads, and writes the parts one
  /// after the other in the items' order. The first exception in that order is thrown.
  void in_parts(std::size_t count, std::size_t grain,
                const std::function<void(TextBuffer& part, std::size_t first, std::size_t last)>& format);
  /// Writes items that are formatted one by one, by each(part, i), like in_parts().
  template <class Each>
  void for_each(std::size_t count, Each each) {
    constexpr std::size_t kGrain = 16384;
    in_parts(count, kGrain, [&](TextBuffer& part, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) each(part, i);
    });
  }
  void finish();

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 20;

  AtomicFile* file_;
  IoContext context_;
  TextBuffer buffer_;
};

// Foreign text within one line of a file.

/// The text with blanks for control characters, line ends among them, so that a title ends with its line.
[[nodiscard]] inline std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return text;
}

/// The text with blanks for line ends only.
[[nodiscard]] inline std::string without_line_ends(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// The text for use between double quotes: a blank for each control character, single quotes for double ones.
[[nodiscard]] inline std::string in_quotes(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  std::ranges::replace(text, '"', '\'');
  return text;
}

// Numbers for formats whose fields have a fixed width.

/// Notation of a power of ten: 1.5e-7, or in Nastran's, which saves a character: 1.5-7.
enum class ExponentStyle { Letter, Sign };

struct FieldNumber {
  std::string text;
  double value = 0.0;  // value that the text reads back as
};

/// A finite double in `width` characters at most (16 or more): exact if that fits, else rounded to as many digits as possible. Always with
/// a point, by which some formats recognise a real number.
[[nodiscard]] FieldNumber number_in_field(double value, std::size_t width, ExponentStyle style);

}  // namespace dmoscope
