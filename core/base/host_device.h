#pragma once
// Macros for code that runs on any processor, a GPU included.

/// Marks a function that a GPU may run as well; replaces constexpr. nvcc can be told to compile constexpr functions for a GPU, too, but
/// then silently drops their calls to functions of the host. In a marked function such a call is an error.
#if defined(__CUDACC__)
#define DMOSCOPE_ANYWHERE __host__ __device__ constexpr
#define DMOSCOPE_INLINE __forceinline__
#define DMOSCOPE_INLINE_LAMBDA __attribute__((always_inline))
#else
#define DMOSCOPE_ANYWHERE constexpr
#define DMOSCOPE_INLINE         // inlined in a device's code: a call would put values into memory that registers hold otherwise
#define DMOSCOPE_INLINE_LAMBDA  // inlines a lambda; stands behind its parameters
#endif

/// Unrolls loops over a few numbers that a GPU's lane must keep in registers, which takes indices that the compiler knows. Elsewhere the
/// compiler decides.
#if defined(__CUDA_ARCH__)
#define DMOSCOPE_UNROLL _Pragma("unroll")
#define DMOSCOPE_NO_UNROLL _Pragma("unroll 1")
#else
#define DMOSCOPE_UNROLL
#define DMOSCOPE_NO_UNROLL
#endif
