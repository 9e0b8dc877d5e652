#include "core/base/returned_memory.h"

#include <malloc.h>

namespace dmoscope {

void return_large_memory() noexcept {
#ifdef M_MMAP_THRESHOLD
  constexpr int kLarge = 4 << 20;  // size in bytes
  (void)::mallopt(M_MMAP_THRESHOLD, kLarge);
#endif
}

}  // namespace dmoscope
