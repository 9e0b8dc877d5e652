#pragma once
// Code that runs on any processor, a GPU's among them.

/// In the place of constexpr, marks a function that a GPU may run as well. Not constexpr alone, which nvcc could be told to take for the
/// same: where such a function calls one that is the host's, nvcc drops the code without a word; from a marked one it is an error.
#if defined(__CUDACC__)
#define DMOSCOPE_ANYWHERE __host__ __device__ constexpr
#define DMOSCOPE_INLINE __forceinline__
#else
#define DMOSCOPE_ANYWHERE constexpr
#define DMOSCOPE_INLINE  // put into a device's code where it is called: a call would keep in memory what is in registers else
#endif

/// For loops over a few numbers that a GPU's lane must keep in registers: there only indices known to the compiler do. Elsewhere the
/// compiler decides.
#if defined(__CUDA_ARCH__)
#define DMOSCOPE_UNROLL _Pragma("unroll")
#define DMOSCOPE_NO_UNROLL _Pragma("unroll 1")
#else
#define DMOSCOPE_UNROLL
#define DMOSCOPE_NO_UNROLL
#endif
