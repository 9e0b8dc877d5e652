#include "core/base/memory.h"

#include <cstdint>

#include <sys/mman.h>

namespace dmoscope {

void advise_large_pages(void* memory, std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t kLargePage = std::size_t{1} << 21U;
  if (bytes < 4 * kLargePage) return;
  // Takes whole large pages only: the partial ones at both ends are shared with other memory.
  const std::size_t skipped = (kLargePage - reinterpret_cast<std::uintptr_t>(memory) % kLargePage) % kLargePage;
  const std::size_t size = (bytes - skipped) / kLargePage * kLargePage;
  (void)::madvise(static_cast<char*>(memory) + skipped, size, MADV_HUGEPAGE);
#else
  (void)memory;
  (void)bytes;
#endif
}

}  // namespace dmoscope
