#pragma once
// Picture of a run's state that lives on a device, for drawing. Knows neither the device nor OpenGL.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/vec.h"
#include "core/run/summary.h"

namespace dmoscope {

/// Two OpenGL buffers that a device has been made to know. Must be destroyed before the buffers are, with their context current.
class DeviceTarget {
 public:
  DeviceTarget() = default;
  DeviceTarget(const DeviceTarget&) = delete;
  DeviceTarget& operator=(const DeviceTarget&) = delete;
  virtual ~DeviceTarget() = default;
};

/// Snapshot of a state on a device: later moves of the smoother do not change it, and it may outlive the smoother. Made on the thread that
/// steps and read by another one meanwhile, one at a time. All functions that ask the device throw DeviceError with a sentence for a
/// person; after that a picture may be asked again or destroyed as if nothing had been.
class DevicePicture {
 public:
  DevicePicture() = default;
  DevicePicture(const DevicePicture&) = delete;
  DevicePicture& operator=(const DevicePicture&) = delete;
  virtual ~DevicePicture() = default;

  /// Summary by the shown metric, worked out on the device when the picture was made; holds at least the worst element that has a quality.
  [[nodiscard]] virtual const ElementSummary& summary() const noexcept = 0;

  /// Makes two buffers of the OpenGL context that is current on the calling thread known to the device, once for all pictures of it:
  /// 8 bytes a vertex and 4 bytes an element at least. Throws DeviceError when this context's drawing is not done by the device.
  [[nodiscard]] virtual std::unique_ptr<DeviceTarget> make_target(std::uint32_t point_buffer, std::uint32_t shade_buffer) const = 0;
  /// Writes into a target of the same device: two floats a vertex (its position in the plane of the mesh, less `origin`, the difference
  /// taken in double), and one float an element (shade_of). Device to device; later draw calls of OpenGL wait for it.
  virtual void write(DeviceTarget& target, Vec2<double> origin) const = 0;

  /// Downloads points and shades through the host's memory. points: one a vertex; shades: one an element.
  virtual void download(std::span<Vec2<float>> points, std::span<float> shades, Vec2<double> origin) const = 0;
  /// Positions of these vertices, in their order, as the run keeps them: for marks and for numbers to read.
  [[nodiscard]] virtual std::vector<Vec3> positions(std::span<const Index> vertices) const = 0;

  /// Bytes of positions and element values that the device has copied to the host so far, by pictures and smoothers together, without
  /// what summary() needs.
  [[nodiscard]] virtual std::uint64_t bytes_to_host() const noexcept = 0;
};

}  // namespace dmoscope
