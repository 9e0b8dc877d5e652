#pragma once
// A kernel that was compiled while dmoscope runs, on a device. By the driver's own library, which the runtime has loaded. Only where CUDA
// is.

#include <cstddef>
#include <string>

#include <cuda.h>

namespace dmoscope::gpu {

class CudaModule {
 public:
  /// On the current device. Throws DeviceError.
  CudaModule(const std::string& ptx, const char* kernel);
  ~CudaModule();
  CudaModule(const CudaModule&) = delete;
  CudaModule& operator=(const CudaModule&) = delete;
  /// Throws DeviceError.
  void launch(std::size_t blocks, unsigned threads, void** arguments, CUstream stream) const;

 private:
  class Driver;
  [[nodiscard]] static const Driver& driver();
  CUmodule module_ = nullptr;
  CUfunction function_ = nullptr;
};

}  // namespace dmoscope::gpu
