#include "gpu/device.h"

#ifdef DMOSCOPE_HAVE_CUDA
#include <cuda_runtime_api.h>
#endif

namespace dmoscope::gpu {

Availability availability() {
  Availability result;
#ifdef DMOSCOPE_HAVE_CUDA
  result.built = true;
  int count = 0;  // cudaGetDeviceCount leaves it untouched on an error
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess) {
    result.reason = std::string("no usable CUDA device: ") + cudaGetErrorString(error);
    return result;
  }
  for (int i = 0; i < count; ++i) {
    cudaDeviceProp properties{};
    if (cudaGetDeviceProperties(&properties, i) == cudaSuccess)
      result.devices.push_back({properties.name, properties.major, properties.minor, properties.totalGlobalMem});
  }
  result.reason = result.devices.empty() ? "no CUDA device found" : "this version smooths on the CPU only; a CUDA search is not built yet";
#else
  result.reason = "built without a CUDA toolkit";
#endif
  return result;
}

}  // namespace dmoscope::gpu
