#pragma once
// What goes wrong in the CUDA runtime becomes a typed error that says where.

#include <string>

#include "core/base/error.h"

namespace dmoscope::gpu {

/// A call of the CUDA runtime failed. what() is "file:line: the expression: the runtime's name of the error: its text".
class CudaError : public DeviceError {
 public:
  /// `code`: the runtime's cudaError_t.
  CudaError(int code, const std::string& what) : DeviceError(what), code_(code) {}
  /// The runtime's number of the error; headers that know CUDA compare it with cudaErrorMemoryAllocation and its like.
  [[nodiscard]] int code() const noexcept { return code_; }

 private:
  int code_;
};

/// Throws the CudaError for `code`, and takes it from the runtime's memory of its last error. `file` loses its folders above gpu/.
[[noreturn]] void throw_cuda_error(int code, const char* expression, const char* file, int line);

}  // namespace dmoscope::gpu

/// Evaluates a call of the CUDA runtime and throws a CudaError unless it succeeded. Where <cuda_runtime_api.h> is included.
#define DMOSCOPE_CUDA_CHECK(expression)                                                                      \
  do {                                                                                                       \
    if (const cudaError_t dmoscope_status = (expression); dmoscope_status != cudaSuccess)                    \
      ::dmoscope::gpu::throw_cuda_error(static_cast<int>(dmoscope_status), #expression, __FILE__, __LINE__); \
  } while (false)
