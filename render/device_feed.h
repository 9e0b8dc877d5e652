#pragma once
// Positions and shades that come from a device: written into OpenGL's buffers by the device itself, else brought through the host. Only for
// sources of this module.

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
  /// until forget_buffers(). Returns false when the device can no longer be read; the buffers' content is then void.
  bool show(std::shared_ptr<const DevicePicture> picture, ElementPainter& painter, const Layout& layout);
  /// Ends showing what comes from a device.
  void clear() noexcept;
  /// Releases the painter's buffers; to be called before they are destroyed or replaced.
  void forget_buffers();
  /// Stops asking the device to write; `why`: for trouble().
  void never_direct(std::string why);

  /// Reason why the device does not write the buffers itself; empty while it can.
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  /// Whether the device itself wrote what was shown last.
  [[nodiscard]] bool direct() const noexcept { return direct_; }

  /// Positions in the picture that was shown last. Throws DeviceError.
  [[nodiscard]] std::vector<Vec3> positions(std::span<const Index> vertices) const { return picture_->positions(vertices); }
  /// All of the picture shown last; brought to the host at most once. Throws DeviceError.
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
