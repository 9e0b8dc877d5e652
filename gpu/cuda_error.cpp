#include "gpu/cuda_error.h"

#include <string_view>

#ifdef DMOSCOPE_HAVE_CUDA
#include <cuda_runtime_api.h>
#endif

namespace dmoscope::gpu {
namespace {

/// Cuts the folders above the root: "/home/me/dmoscope/gpu/queue.cu" -> "gpu/queue.cu".
std::string_view below_root(std::string_view file) {
  const std::size_t below = file.rfind("gpu/");
  return below == std::string_view::npos ? file : file.substr(below);
}

std::string sentence(int code) {
#ifdef DMOSCOPE_HAVE_CUDA
  const auto error = static_cast<cudaError_t>(code);
  return std::string(cudaGetErrorName(error)) + ": " + cudaGetErrorString(error);
#else
  return "CUDA error " + std::to_string(code);
#endif
}

}  // namespace

void throw_cuda_error(int code, const char* expression, const char* file, int line) {
#ifdef DMOSCOPE_HAVE_CUDA
  (void)cudaGetLastError();  // clears the error: else the check of the next launch would find it
#endif
  throw CudaError(code, std::string(below_root(file)) + ":" + std::to_string(line) + ": " + expression + ": " + sentence(code));
}

}  // namespace dmoscope::gpu
