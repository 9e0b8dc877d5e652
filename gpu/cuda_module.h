#pragma once
// A kernel that was compiled at run time, loaded on a device by the driver's own library, which the CUDA runtime has loaded. Needs a CUDA
// toolkit.

#include <cstddef>
#include <string>

#include <cuda.h>

namespace dmoscope::gpu {

class CudaModule {
 public:
  /// Loads the kernel on the current device. Throws DeviceError.
  CudaModule(const std::string& ptx, const char* kernel);
  ~CudaModule();
  CudaModule(const CudaModule&) = delete;
  CudaModule& operator=(const CudaModule&) = delete;
  /// Launches the kernel. Throws DeviceError.
  void launch(std::size_t blocks, unsigned threads, void** arguments, CUstream stream) const;

 private:
  class Driver;
  [[nodiscard]] static const Driver& driver();
  CUmodule module_ = nullptr;
  CUfunction function_ = nullptr;
};

}  // namespace dmoscope::gpu
