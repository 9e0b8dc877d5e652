#pragma once
// Cursor over an MSH file: numbers are words in an ASCII file and bytes in a binary one.

#include <cstdint>
#include <string_view>

#include "core/io/reading/binary.h"
#include "core/io/reading/mixed_input.h"

namespace dmoscope {

class GmshInput {
 public:
  GmshInput(const SourceFile& source, Progress& progress) : words(source, progress) {}

  /// Goes to the bytes that follow in a binary file: leaves the present line.
  void begin_data() {
    if (binary) (void)words.rest_of_line();
  }
  /// Reads an int.
  [[nodiscard]] int whole(std::string_view what);
  /// Reads a size_t of version 4.1.
  [[nodiscard]] std::int64_t size(std::string_view what);
  [[nodiscard]] double real(std::string_view what);
  /// Reads a count (size_t) of entries that the rest of the file can hold, each of `text` or `bytes` bytes. Throws InputError.
  [[nodiscard]] std::size_t count(std::string_view what, double text, double bytes);
  /// Decodes a number of a block from words.block().
  [[nodiscard]] int int_at(const char* bytes) const noexcept { return load_number<std::int32_t>(bytes, big_endian); }
  [[nodiscard]] std::int64_t size_at(const char* bytes) const noexcept { return load_number<std::int64_t>(bytes, big_endian); }
  [[nodiscard]] double real_at(const char* bytes) const noexcept { return load_number<double>(bytes, big_endian); }

  MixedInput words;
  bool binary = false;
  bool big_endian = false;
  int version = 0;  // 2, or 4 for 4.1

 private:
  std::int64_t any_count(std::int64_t n, std::string_view what) const;
};

}  // namespace dmoscope
