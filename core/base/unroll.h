#pragma once
// Loops over a few numbers that a GPU's lane must keep in registers: there only indices known to the compiler do. Elsewhere the compiler
// decides.

#if defined(__CUDACC__)
#define DMOSCOPE_UNROLL _Pragma("unroll")
#define DMOSCOPE_NO_UNROLL _Pragma("unroll 1")
#else
#define DMOSCOPE_UNROLL
#define DMOSCOPE_NO_UNROLL
#endif
