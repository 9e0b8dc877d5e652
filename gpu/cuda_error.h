#pragma once
// Turns errors of the CUDA runtime into typed errors with file and line.

#include <string>

#include "core/base/error.h"

namespace dmoscope::gpu {

/// Error for a failed call of the CUDA runtime. what() is "file:line: the expression: the runtime's name of the error: its text".
class CudaError : public DeviceError {
 public:
  /// `code`: the runtime's cudaError_t.
  CudaError(int code, const std::string& what) : DeviceError(what), code_(code) {}
  /// The runtime's number of the error, such as cudaErrorMemoryAllocation, which headers that know CUDA can compare it with.
  [[nodiscard]] int code() const noexcept { return code_; }

 private:
  int code_;
};

/// Throws the CudaError for `code`, and clears the runtime's last error. `file` loses its folders above gpu/.
[[noreturn]] void throw_cuda_error(int code, const char* expression, const char* file, int line);

}  // namespace dmoscope::gpu

/// Evaluates a call of the CUDA runtime and throws a CudaError unless it succeeded. Needs <cuda_runtime_api.h>.
#define DMOSCOPE_CUDA_CHECK(expression)                                                                      \
  do {                                                                                                       \
    if (const cudaError_t dmoscope_status = (expression); dmoscope_status != cudaSuccess)                    \
      ::dmoscope::gpu::throw_cuda_error(static_cast<int>(dmoscope_status), #expression, __FILE__, __LINE__); \
  } while (false)
