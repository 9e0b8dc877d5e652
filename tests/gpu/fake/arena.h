#pragma once
// Memory that the host may not touch but where a device would.

#include <cstddef>

namespace dmoscope::gpu::fake {

/// Addresses are never given twice until clear(), so that whatever uses memory that was freed is seen.
class Arena {
 public:
  Arena();
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  /// Null where there is no more. Filled with 0xcd. Only while it is open.
  [[nodiscard]] void* take(std::size_t bytes);
  void clear();
  void open();
  void close();

 private:
  std::byte* begin_ = nullptr;
  std::size_t used_ = 0, opened_ = 0;
};

}  // namespace dmoscope::gpu::fake
