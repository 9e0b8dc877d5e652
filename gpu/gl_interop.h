#pragma once
// Buffers of OpenGL as memory of a CUDA device. Needs no OpenGL itself, only the buffers' names.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "core/run/device_picture.h"

struct CUstream_st;  // cudaStream_t is a pointer to it
struct CUevent_st;   // cudaEvent_t
struct cudaGraphicsResource;

namespace dmoscope::gpu {

/// Returns why a CUDA device cannot write the buffers of the OpenGL context that is current on the calling thread, as a sentence for the
/// user; empty if it can. `device`: the runtime's number of it. Never throws.
[[nodiscard]] std::string gl_obstacle(int device);

/// Two buffers of the current OpenGL context, registered with a device for being overwritten. Made, used and destroyed on the thread on
/// which that context is current, which has `device` as its CUDA device from then on.
class GlTarget final : public DeviceTarget {
 public:
  /// Registers both buffers. Throws DeviceError with gl_obstacle's sentence or the runtime's error.
  GlTarget(int device, std::uint32_t point_buffer, std::uint32_t shade_buffer);
  ~GlTarget() override;

  /// Present addresses of both buffers in the device's memory.
  struct Mapped {
    float* points;
    std::size_t point_bytes;
    float* shades;
    std::size_t shade_bytes;
  };
  /// Maps both buffers, has `enqueue` put work on `stream`, and unmaps them. That work begins when OpenGL has done with the buffers and
  /// when `ready` has happened (null: at once), and OpenGL draws later commands after the work is done. Does not wait itself. The former
  /// content of the buffers is lost. Throws DeviceError, also errors of `enqueue`; nothing stays mapped.
  void fill(CUstream_st* stream, CUevent_st* ready, const std::function<void(const Mapped&)>& enqueue);

 private:
  int device_;
  cudaGraphicsResource* resources_[2] = {nullptr, nullptr};  // points, shades
};

}  // namespace dmoscope::gpu
