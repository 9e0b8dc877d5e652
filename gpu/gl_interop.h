#pragma once
// Buffers of OpenGL as memory of a CUDA device. Needs no OpenGL itself: it is told the buffers' names.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "core/run/device_picture.h"

struct CUstream_st;  // cudaStream_t is a pointer to it
struct CUevent_st;   // cudaEvent_t
struct cudaGraphicsResource;

namespace dmoscope::gpu {

/// Why a CUDA device cannot write the buffers of the OpenGL context that is current on the calling thread, as a sentence for a person;
/// empty when it can. `device`: the runtime's number of it. Never throws.
[[nodiscard]] std::string gl_obstacle(int device);

/// Two buffers of the current OpenGL context, registered with a device for being overwritten. Made, used and destroyed on the thread on
/// which that context is current, which has `device` as its CUDA device from then on.
class GlTarget final : public DeviceTarget {
 public:
  /// Throws DeviceError: gl_obstacle's sentence, or what the runtime says.
  GlTarget(int device, std::uint32_t point_buffer, std::uint32_t shade_buffer);
  ~GlTarget() override;

  /// The device's memory that OpenGL's buffers are just now.
  struct Mapped {
    float* points;
    std::size_t point_bytes;
    float* shades;
    std::size_t shade_bytes;
  };
  /// Maps both at once, has `enqueue` put work on `stream`, and unmaps: that work begins when OpenGL has done with the buffers and when
  /// `ready` has happened (null: at once), and what OpenGL is told to draw later begins when the work is done. Waits for nothing itself.
  /// What the buffers held before is lost. Throws DeviceError, also what `enqueue` throws; nothing stays mapped.
  void fill(CUstream_st* stream, CUevent_st* ready, const std::function<void(const Mapped&)>& enqueue);

 private:
  int device_;
  cudaGraphicsResource* resources_[2] = {nullptr, nullptr};  // points, shades
};

}  // namespace dmoscope::gpu
