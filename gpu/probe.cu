#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <exception>

#include <cuda_runtime.h>

#include "gpu/cuda_error.h"
#include "gpu/probe.h"

namespace dmoscope::gpu {
namespace {

/// Results that are compared between host and device. Each depends on something that a compiler or a device may do otherwise.
struct Values {
  float sum_of_product;  // 2^-11; 2^-11 + 2^-24 if contracted into one operation
  float subnormal;       // 0 if flushed
  float quotient, root;  // another last bit if approximated
  double quotient_of_doubles;
};

struct Inputs {
  float a = 1.0F + 0x1p-12F, tiny = 0x1.8p-126F, seven = 7.0F;
  double third = 3.0;
};

__host__ __device__ Values compute(const Inputs& in) {
  return {in.a * in.a - 1.0F, in.tiny * 0.25F, in.a / in.seven, std::sqrt(in.seven), static_cast<double>(in.a) / in.third};
}

__global__ void probe_kernel(Inputs in, Values* out) { *out = compute(in); }

bool same_bits(const Values& one, const Values& other) {
  const auto bits = [](const Values& of) {
    return std::array<std::uint64_t, 5>{std::bit_cast<std::uint32_t>(of.sum_of_product), std::bit_cast<std::uint32_t>(of.subnormal),
                                        std::bit_cast<std::uint32_t>(of.quotient), std::bit_cast<std::uint32_t>(of.root),
                                        std::bit_cast<std::uint64_t>(of.quotient_of_doubles)};
  };
  return bits(one) == bits(other);
}

/// The device's memory for one Values. The device stays current on the thread, for making another one current again might take memory on
/// that one.
class Scope {
 public:
  explicit Scope(int device) {
    DMOSCOPE_CUDA_CHECK(cudaSetDevice(device));
    DMOSCOPE_CUDA_CHECK(cudaMalloc(&values_, sizeof(Values)));
  }
  ~Scope() {
    (void)cudaFree(values_);
    (void)cudaGetLastError();  // the next device must not see this one's errors
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
  [[nodiscard]] Values* values() const { return values_; }

 private:
  Values* values_ = nullptr;
};

}  // namespace

std::string probe(int device) {
  try {
    const Scope scope(device);
    Inputs in;
    Values* values = scope.values();
    void* arguments[] = {&in, &values};
    // Not <<<>>>: its status would be that of the thread's last failure, and if the first device has no such kernel it would not ask the
    // others for it.
    DMOSCOPE_CUDA_CHECK(cudaLaunchKernel(probe_kernel, dim3(1), dim3(1), arguments, 0, nullptr));
    Values out{};
    DMOSCOPE_CUDA_CHECK(cudaMemcpy(&out, scope.values(), sizeof out, cudaMemcpyDeviceToHost));
    return same_bits(out, compute(in)) ? "" : "its arithmetic differs from the processor's";
  } catch (const CudaError& error) {
    if (error.code() == cudaErrorNoKernelImageForDevice) return "the program was not built for its compute capability";
    return error.what();
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace dmoscope::gpu
