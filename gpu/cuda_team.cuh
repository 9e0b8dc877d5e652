#pragma once
// Eight lanes of a warp that search one star together: see core/search/team.h.

#include <cstring>
#include <type_traits>

namespace dmoscope::gpu {

class CudaTeam {
 public:
  static constexpr unsigned kSize = 8;

  __device__ CudaTeam() : lane_(threadIdx.x % kSize), members_(0xffU << (threadIdx.x % 32U / kSize * kSize)) {}
  [[nodiscard]] __device__ unsigned lane() const { return lane_; }
  template <class T>
  [[nodiscard]] __device__ T exchange(T value, unsigned mask) const {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(unsigned) == 0);
    unsigned words[sizeof(T) / sizeof(unsigned)];
    std::memcpy(words, &value, sizeof(T));
#pragma unroll
    for (unsigned& word : words) word = __shfl_xor_sync(members_, word, static_cast<int>(mask));
    std::memcpy(&value, words, sizeof(T));
    return value;
  }

 private:
  unsigned lane_, members_;
};

}  // namespace dmoscope::gpu
