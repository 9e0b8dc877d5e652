#include "gpu/device.h"

#ifdef DMOSCOPE_HAVE_CUDA
#include <cuda_runtime_api.h>

#include "gpu/probe.h"
#endif

namespace dmoscope::gpu {
#ifdef DMOSCOPE_HAVE_CUDA
namespace {

/// The runtime calls a driver that is not there one that is too old.
std::string why(cudaError_t error) {
  int driver = 0;
  if (error == cudaErrorInsufficientDriver && cudaDriverGetVersion(&driver) == cudaSuccess && driver == 0)
    return "no NVIDIA driver is installed";
  return cudaGetErrorString(error);
}

/// All but whether its kernels run.
Device describe(int number) {
  cudaDeviceProp properties{};
  if (const cudaError_t error = cudaGetDeviceProperties(&properties, number); error != cudaSuccess) {
    (void)cudaGetLastError();
    return {.name = "CUDA device " + std::to_string(number), .problem = cudaGetErrorString(error)};
  }
  return {.name = properties.name, .major = properties.major, .minor = properties.minor, .memory = properties.totalGlobalMem};
}

}  // namespace
#endif

Availability availability() {
  Availability result;
#ifdef DMOSCOPE_HAVE_CUDA
  result.built = true;
  int count = 0;  // cudaGetDeviceCount leaves it untouched on an error
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess) {
    result.reason = std::string("no usable CUDA device: ") + why(error);
    return result;
  }
  result.reason = "no CUDA device found";
  std::size_t most_memory = 0;
  for (int i = 0; i < count; ++i) {
    Device& device = result.devices.emplace_back(describe(i));
    if (device.problem.empty()) device.problem = probe(i);
    if (!device.problem.empty()) {
      if (result.best < 0) result.reason = device.name + ": " + device.problem;
    } else if (device.memory > most_memory) {
      result.best = i;
      most_memory = device.memory;
      result.reason.clear();
    }
  }
#else
  result.reason = "built without a CUDA toolkit";
#endif
  return result;
}

}  // namespace dmoscope::gpu
