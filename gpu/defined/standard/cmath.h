#pragma once
namespace std {
__device__ inline float sqrt(float a) { return ::sqrtf(a); }
__device__ inline double sqrt(double a) { return ::sqrt(a); }
__device__ inline float fabs(float a) { return ::fabsf(a); }
__device__ inline double fabs(double a) { return ::fabs(a); }
}  // namespace std
