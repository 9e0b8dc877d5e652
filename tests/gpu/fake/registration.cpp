// Calls of nvcc's code before main(), and for kernel<<<...>>>.

#include "tests/gpu/fake/machine.h"

using namespace dmoscope::gpu::fake;

extern "C" {

// Declared here as nvcc's headers do, for they are not for others to include.
void** __cudaRegisterFatBinary(void* code);
void __cudaRegisterFatBinaryEnd(void** binary);
void __cudaUnregisterFatBinary(void** binary);
void __cudaRegisterFunction(void** binary, const char* host, char* device, const char* name, int limit, uint3* thread, uint3* block,
                            dim3* threads, dim3* blocks, int* warp);
unsigned __cudaPushCallConfiguration(dim3 grid, dim3 block, std::size_t shared, CUstream_st* stream);
cudaError_t __cudaPopCallConfiguration(dim3* grid, dim3* block, std::size_t* shared, void* stream);
cudaError_t __cudaGetKernel(cudaKernel_t* kernel, const void* function);
cudaError_t __cudaLaunchKernel(cudaKernel_t kernel, dim3 grid, dim3 block, void** arguments, std::size_t shared, cudaStream_t stream);

void** __cudaRegisterFatBinary(void* code) { return static_cast<void**>(code); }
void __cudaRegisterFatBinaryEnd(void** /*binary*/) {}
void __cudaUnregisterFatBinary(void** /*binary*/) {}
void __cudaRegisterFunction(void** /*binary*/, const char* host, char* /*device*/, const char* name, int /*limit*/, uint3* /*thread*/,
                            uint3* /*block*/, dim3* /*threads*/, dim3* /*blocks*/, int* /*warp*/) {
  Machine::get().functions[host] = name;
}

unsigned __cudaPushCallConfiguration(dim3 grid, dim3 block, std::size_t shared, CUstream_st* stream) {
  return static_cast<unsigned>(call("__cudaPushCallConfiguration", [&](Machine&) {
    this_thread().configurations.emplace_back(grid, block, shared, stream);
    return cudaSuccess;
  }));
}
cudaError_t __cudaPopCallConfiguration(dim3* grid, dim3* block, std::size_t* shared, void* stream) {
  auto& configurations = this_thread().configurations;
  if (configurations.empty()) return cudaErrorMissingConfiguration;
  std::tie(*grid, *block, *shared, *static_cast<cudaStream_t*>(stream)) = configurations.back();
  configurations.pop_back();
  return cudaSuccess;
}
/// Returns a kernel's handle; nvcc's code asks once and keeps the answer, even an error.
cudaError_t __cudaGetKernel(cudaKernel_t* kernel, const void* function) {
  return call("__cudaGetKernel", [&](const Machine&) {
    *kernel = static_cast<cudaKernel_t>(const_cast<void*>(function));
    return cudaSuccess;
  });
}
cudaError_t __cudaLaunchKernel(cudaKernel_t kernel, dim3 grid, dim3 block, void** arguments, std::size_t shared, cudaStream_t stream) {
  return call("__cudaLaunchKernel", [&](Machine& machine) { return machine.launch(kernel, grid, block, arguments, shared, stream); });
}

}  // extern "C"
