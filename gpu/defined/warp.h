#pragma once
// All lanes of a warp, which search one star together: see core/search/team.h.

#include "core/base/host_device.h"

namespace dmoscope::gpu {

#if defined(__CUDACC__)

class Warp {
 public:
  static constexpr unsigned kSize = 32;

  [[nodiscard]] __device__ unsigned lane() const { return threadIdx.x % kSize; }
  template <class T>
  [[nodiscard]] __device__ T exchange(T value, unsigned mask) const {
    static_assert(sizeof(T) % sizeof(unsigned) == 0);
    unsigned words[sizeof(T) / sizeof(unsigned)];
    memcpy(words, &value, sizeof(T));
#pragma unroll
    for (unsigned& word : words) word = __shfl_xor_sync(0xffffffffU, word, static_cast<int>(mask));
    memcpy(&value, words, sizeof(T));
    return value;
  }
};

#endif

}  // namespace dmoscope::gpu
