#include "gpu/gl_interop.h"

#ifdef DMOSCOPE_HAVE_CUDA

#include <algorithm>
#include <array>
#include <utility>

#include <cuda_runtime_api.h>
#include <fmt/format.h>

#include "gpu/cuda_error.h"

// The toolkit's header includes OpenGL's, of which it uses only the type of buffers' names. If OpenGL's headers are not installed its
// declarations are repeated.
#if __has_include(<GL/gl.h>)
#include <cuda_gl_interop.h>
#else
enum cudaGLDeviceList { cudaGLDeviceListAll = 1 };
extern "C" cudaError_t cudaGLGetDevices(unsigned int* count, int* devices, unsigned int capacity, enum cudaGLDeviceList list);
extern "C" cudaError_t cudaGraphicsGLRegisterBuffer(struct cudaGraphicsResource** resource, unsigned int buffer, unsigned int flags);
#endif

namespace dmoscope::gpu {
namespace {

/// Both buffers as memory of the device, mapped during the object's life.
class Mapping {
 public:
  Mapping(cudaGraphicsResource** resources, cudaStream_t stream) : resources_(resources), stream_(stream) {
    DMOSCOPE_CUDA_CHECK(cudaGraphicsMapResources(2, resources_, stream_));
  }
  ~Mapping() {
    if (resources_ != nullptr) (void)cudaGraphicsUnmapResources(2, resources_, stream_);
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  [[nodiscard]] GlTarget::Mapped memory() const {
    GlTarget::Mapped mapped{};
    void *points = nullptr, *shades = nullptr;
    DMOSCOPE_CUDA_CHECK(cudaGraphicsResourceGetMappedPointer(&points, &mapped.point_bytes, resources_[0]));
    DMOSCOPE_CUDA_CHECK(cudaGraphicsResourceGetMappedPointer(&shades, &mapped.shade_bytes, resources_[1]));
    mapped.points = static_cast<float*>(points);
    mapped.shades = static_cast<float*>(shades);
    return mapped;
  }
  void end() {
    cudaGraphicsResource** mapped = std::exchange(resources_, nullptr);
    DMOSCOPE_CUDA_CHECK(cudaGraphicsUnmapResources(2, mapped, stream_));
  }

 private:
  cudaGraphicsResource** resources_;
  cudaStream_t stream_;
};

}  // namespace

namespace {
/// Advice for laptops with two GPUs, on which the other one draws by default.
constexpr std::string_view kTwoGpus =
    "; on a computer with two GPUs, start the program with __NV_PRIME_RENDER_OFFLOAD=1 __GLX_VENDOR_LIBRARY_NAME=nvidia";
}  // namespace

std::string gl_obstacle(int device) {
  std::array<int, 16> devices{};
  unsigned count = 0;
  const cudaError_t error = cudaGLGetDevices(&count, devices.data(), devices.size(), cudaGLDeviceListAll);
  if (error != cudaSuccess) {
    (void)cudaGetLastError();
    return fmt::format("OpenGL does not draw on a device of CUDA ({}: {}){}", cudaGetErrorName(error), cudaGetErrorString(error), kTwoGpus);
  }
  const auto end = devices.begin() + std::min<std::size_t>(count, devices.size());
  if (std::find(devices.begin(), end, device) != end) return {};
  if (count == 0) return fmt::format("OpenGL does not draw on a device of CUDA{}", kTwoGpus);
  return fmt::format("OpenGL draws on CUDA device {0}, but device {1} smooths; with CUDA_VISIBLE_DEVICES={0} one does both", devices[0],
                     device);
}

GlTarget::GlTarget(int device, std::uint32_t point_buffer, std::uint32_t shade_buffer) : device_(device) {
  DMOSCOPE_CUDA_CHECK(cudaSetDevice(device_));
  if (const std::string obstacle = gl_obstacle(device_); !obstacle.empty()) throw DeviceError(obstacle);
  DMOSCOPE_CUDA_CHECK(cudaGraphicsGLRegisterBuffer(&resources_[0], point_buffer, cudaGraphicsRegisterFlagsWriteDiscard));
  const cudaError_t second = cudaGraphicsGLRegisterBuffer(&resources_[1], shade_buffer, cudaGraphicsRegisterFlagsWriteDiscard);
  if (second == cudaSuccess) return;
  (void)cudaGraphicsUnregisterResource(resources_[0]);
  throw_cuda_error(static_cast<int>(second), "cudaGraphicsGLRegisterBuffer of the shades", __FILE__, __LINE__);
}

GlTarget::~GlTarget() {
  // Errors are ignored in a destructor; the buffers are destroyed anyway.
  (void)cudaSetDevice(device_);
  for (cudaGraphicsResource* resource : resources_) (void)cudaGraphicsUnregisterResource(resource);
  (void)cudaGetLastError();
}

void GlTarget::fill(CUstream_st* stream, CUevent_st* ready, const std::function<void(const Mapped&)>& enqueue) {
  DMOSCOPE_CUDA_CHECK(cudaSetDevice(device_));
  if (ready != nullptr) DMOSCOPE_CUDA_CHECK(cudaStreamWaitEvent(stream, ready, 0));
  Mapping mapping(resources_, stream);
  enqueue(mapping.memory());
  mapping.end();
}

}  // namespace dmoscope::gpu

#else

namespace dmoscope::gpu {

std::string gl_obstacle(int) { return "built without a CUDA toolkit"; }

}  // namespace dmoscope::gpu

#endif
