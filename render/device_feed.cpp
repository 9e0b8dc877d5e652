#include "render/device_feed.h"

#include <utility>

#include "core/base/error.h"

namespace dmoscope::render {

bool DeviceFeed::show(std::shared_ptr<const DevicePicture> picture, ElementPainter& painter, const Layout& layout) {
  picture_ = std::move(picture);
  copied_ = false;
  direct_ = write(painter, layout.origin);
  if (direct_) return true;
  try {
    const HostCopy& copy = host_copy(layout);
    painter.upload_points(copy.points);
    painter.upload_shades(copy.shades);
    return true;
  } catch (const DeviceError& error) {
    trouble_ = error.what();
    return false;
  }
}

bool DeviceFeed::write(const ElementPainter& painter, Vec2<double> origin) {
  if (!trouble_.empty()) return false;
  try {
    if (!target_) target_ = picture_->make_target(painter.point_buffer(), painter.shade_buffer());
    picture_->write(*target_, origin);
    return true;
  } catch (const DeviceError& error) {
    target_.reset();
    trouble_ = error.what();
    return false;
  }
}

void DeviceFeed::clear() noexcept {
  picture_.reset();
  copied_ = direct_ = false;
}

void DeviceFeed::forget_buffers() {
  clear();
  target_.reset();
  trouble_ = never_;
}

void DeviceFeed::never_direct(std::string why) {
  never_ = std::move(why);
  target_.reset();
  trouble_ = never_;
}

const DeviceFeed::HostCopy& DeviceFeed::host_copy(const Layout& layout) {
  if (copied_) return copy_;
  copy_.points.resize(layout.vertex_count);
  copy_.shades.resize(layout.element_count());
  picture_->download(copy_.points, copy_.shades, layout.origin);
  copied_ = true;
  return copy_;
}

}  // namespace dmoscope::render
