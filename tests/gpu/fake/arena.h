#pragma once
// Memory that is accessible to the host only while a device would work on it.

#include <cstddef>

namespace dmoscope::gpu::fake {

/// Memory whose addresses are never reused until clear(), so that uses of freed memory are detected.
class Arena {
 public:
  Arena();
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  /// Returns memory filled with 0xcd, or null if there is no more. Only while the arena is open.
  [[nodiscard]] void* take(std::size_t bytes);
  void clear();
  void open();
  void close();

 private:
  std::byte* begin_ = nullptr;
  std::size_t used_ = 0, opened_ = 0;
};

}  // namespace dmoscope::gpu::fake
