#pragma once
// Eight lanes of a warp that search one star together: see core/search/team.h.

#include <cstddef>
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

 protected:
  unsigned lane_, members_;
};

/// Team with memory in common, in blocks of `Threads`. Each team is for one search.
template <unsigned Threads, std::size_t Bytes>
class StagingCudaTeam : public CudaTeam {
 public:
  static constexpr std::size_t kScratchBytes = Bytes;
  [[nodiscard]] __device__ void* scratch() const {
    // An odd number of 16-byte words, so that the teams of a warp, each reading the same place of its own memory, use different banks.
    __shared__ uint4 memory[Threads / kSize][(Bytes + sizeof(uint4) - 1) / sizeof(uint4) | 1U];
    return memory[threadIdx.x / kSize];
  }
  /// Waits for all lanes of the team: each then reads what any of them wrote to the memory in common.
  __device__ void meet() const { __syncwarp(members_); }
};

}  // namespace dmoscope::gpu
