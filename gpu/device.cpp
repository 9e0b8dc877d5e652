#include "gpu/device.h"

#include <algorithm>
#include <functional>
#include <numeric>

#ifdef DMOSCOPE_HAVE_CUDA
#include <cuda_runtime_api.h>

#include "gpu/probe.h"
#endif

namespace dmoscope::gpu {
#ifdef DMOSCOPE_HAVE_CUDA
namespace {

/// Describes an error of the runtime, which calls a driver that is missing one that is too old.
std::string why(cudaError_t error) {
  int driver = 0;
  if (error == cudaErrorInsufficientDriver && cudaDriverGetVersion(&driver) == cudaSuccess && driver == 0)
    return "no NVIDIA driver is installed";
  return cudaGetErrorString(error);
}

/// Properties of a device, but not whether it runs this program's kernels.
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
  for (int i = 0; i < count; ++i) result.devices.push_back(describe(i));
  std::vector<int> by_memory(result.devices.size());
  std::iota(by_memory.begin(), by_memory.end(), 0);
  const auto device = [&](int number) -> Device& { return result.devices[static_cast<std::size_t>(number)]; };
  std::ranges::stable_sort(by_memory, std::greater{}, [&](int number) { return device(number).memory; });
  for (const int number : by_memory) {
    if (device(number).problem.empty()) device(number).problem = probe(number);
    if (device(number).problem.empty()) {
      result.best = number;
      result.reason.clear();
      break;  // the others are not tried: that takes time and some of their memory
    }
    if (number == by_memory.front()) result.reason = device(number).name + ": " + device(number).problem;
  }
#else
  result.reason = "built without a CUDA toolkit";
#endif
  return result;
}

}  // namespace dmoscope::gpu
