#pragma once
// Positions and shades that come from a device: by its own writing into OpenGL's buffers, else through the host. Only for sources of
// this module.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/run/device_picture.h"
#include "render/element_painter.h"

namespace dmoscope::render {

class DeviceFeed {
 public:
  /// Brings a picture into the painter's buffers, which are large enough. Once the device could not write them itself it is not tried again
  /// until forget_buffers(). False: the device tells nothing any more, and what the buffers hold is void.
  bool show(std::shared_ptr<const DevicePicture> picture, ElementPainter& painter, const Layout& layout);
  /// From now on what is shown does not come from a device.
  void clear() noexcept;
  /// To be called before the painter's buffers are destroyed or replaced.
  void forget_buffers();
  /// From now on the device is not asked to write; `why`: for trouble().
  void never_direct(std::string why);

  /// Why the device does not write the buffers itself; empty while it can.
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  /// Did the device write itself what was shown last?
  [[nodiscard]] bool direct() const noexcept { return direct_; }

  /// Positions in the picture that was shown last. Throws DeviceError.
  [[nodiscard]] std::vector<Vec3> positions(std::span<const Index> vertices) const { return picture_->positions(vertices); }
  /// All of the picture shown last, brought to the host at most once. Throws DeviceError.
  struct HostCopy {
    std::vector<Vec2<float>> points;  // relative to the layout's origin
    std::vector<float> shades;
  };
  [[nodiscard]] const HostCopy& host_copy(const Layout& layout);

 private:
  bool write(const ElementPainter& painter, Vec2<double> origin);
  std::shared_ptr<const DevicePicture> picture_;
  std::unique_ptr<DeviceTarget> target_;
  std::string trouble_, never_;
  HostCopy copy_;
  bool copied_ = false, direct_ = false;
};

}  // namespace dmoscope::render
