#pragma once
// A short hash of bytes (FNV-1a, 64 bits): detects damage, but no intended forgery.

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace dmoscope {

class Fnv1a {
 public:
  void add_bytes(std::string_view bytes) noexcept {
    for (const char byte : bytes) add(static_cast<unsigned char>(byte));
  }
  /// Adds the number's eight bytes, the lowest first.
  void add_number(std::uint64_t value) noexcept {
    for (unsigned k = 0; k < 8; ++k) add(value >> 8U * k & 255U);
  }
  /// The hash as 16 hexadecimal digits.
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  void add(std::uint64_t byte) noexcept { hash_ = (hash_ ^ byte) * 1099511628211ULL; }

  std::uint64_t hash_ = 14695981039346656037ULL;
};

}  // namespace dmoscope
