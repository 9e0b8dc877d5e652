#pragma once
// Differences between a device and the host that stands in for it.

#include <cstdint>

/// Marks functions that are not constexpr and that run on a device, or on the host in its place.
#if defined(__CUDACC__)
#define DMOSCOPE_LANE __host__ __device__
#else
#define DMOSCOPE_LANE
#endif

/// Inlines a function on a device, however long it is: a call would move values from registers to memory.
#if defined(__CUDACC__)
#define DMOSCOPE_LANE_INLINE __forceinline__
#else
#define DMOSCOPE_LANE_INLINE inline
#endif

namespace dmoscope::gpu {

/// Adds one and returns the value before. Lanes of a warp that come together share one addition.
[[nodiscard]] inline DMOSCOPE_LANE std::uint32_t increment(std::uint32_t* counter) {
#if defined(__CUDA_ARCH__)
  const unsigned lanes = __activemask();
  const int first = __ffs(static_cast<int>(lanes)) - 1;
  const unsigned lane = threadIdx.x % 32U;
  std::uint32_t before = 0;
  if (static_cast<int>(lane) == first) before = atomicAdd(counter, static_cast<std::uint32_t>(__popc(lanes)));
  before = __shfl_sync(lanes, before, first);
  return before + static_cast<std::uint32_t>(__popc(lanes & ((1U << lane) - 1U)));
#else
  return __atomic_fetch_add(counter, 1U, __ATOMIC_RELAXED);
#endif
}

/// Adds one to a counter that is not the same for all lanes of a warp.
inline DMOSCOPE_LANE void count_one(std::uint32_t* counter) {
#if defined(__CUDA_ARCH__)
  atomicAdd(counter, 1U);
#else
  __atomic_fetch_add(counter, 1U, __ATOMIC_RELAXED);
#endif
}

/// Sets a flag that several lanes may set to the same value at once.
inline DMOSCOPE_LANE void set_flag(std::uint8_t* flag, bool value) {
#if defined(__CUDA_ARCH__)
  *flag = value ? 1 : 0;
#else
  __atomic_store_n(flag, value ? std::uint8_t{1} : std::uint8_t{0}, __ATOMIC_RELAXED);
#endif
}
[[nodiscard]] inline DMOSCOPE_LANE bool is_set(const std::uint8_t* flag) {
#if defined(__CUDA_ARCH__)
  return *flag != 0;
#else
  return __atomic_load_n(flag, __ATOMIC_RELAXED) != 0;
#endif
}

}  // namespace dmoscope::gpu
