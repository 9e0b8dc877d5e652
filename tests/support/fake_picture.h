#pragma once
// A "device" whose memory is the host's, with switches that make it fail and counters of its calls.

#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/run/device_picture.h"
#include "core/view/frame_builder.h"

namespace dmoscope::testing {

struct FakePictureDevice {
  bool can_snapshot = true, can_write = true, can_download = true, can_tell_positions = true;
  int targets_made = 0, targets_alive = 0, writes = 0, downloads = 0;
  std::size_t positions_told = 0;
  /// Fills OpenGL's buffers; tests that have OpenGL set it.
  std::function<void(std::uint32_t buffer, std::span<const std::byte> data)> fill = [](std::uint32_t, std::span<const std::byte>) {};
};

class FakeTarget final : public DeviceTarget {
 public:
  FakeTarget(std::shared_ptr<FakePictureDevice> device, std::uint32_t points, std::uint32_t shades)
      : point_buffer(points), shade_buffer(shades), device_(std::move(device)) {
    ++device_->targets_made;
    ++device_->targets_alive;
  }
  ~FakeTarget() override { --device_->targets_alive; }
  const std::uint32_t point_buffer, shade_buffer;

 private:
  std::shared_ptr<FakePictureDevice> device_;
};

class FakePicture final : public DevicePicture {
 public:
  FakePicture(std::shared_ptr<FakePictureDevice> device, std::shared_ptr<const InputMesh> input, std::vector<Vec3> positions, Metric shown)
      : device_(std::move(device)), input_(std::move(input)), positions_(std::move(positions)) {
    const QualityContext context = input_->quality_context();
    std::vector<double> quality(input_->mesh.elements.size());
    element_qualities(context, positions_, shown, nullptr, quality);
    for (Index e = 0; e < quality.size(); ++e)
      shades_.push_back(shade_of(static_cast<float>(quality[e]), smallest_jacobian(context, positions_, e) <= 0.0));
    summary_.statistics = compute_statistics(context, positions_, shown, std::span<const Index>{}, nullptr);
    summary_.histogram = make_histogram(quality);
    summary_.worst = worst_elements(quality, 1);
    for (RankedElement& ranked : summary_.worst) ranked.inverted = shades_[ranked.element] == kInvertedShade;
  }
  [[nodiscard]] const ElementSummary& summary() const noexcept override { return summary_; }
  [[nodiscard]] std::unique_ptr<DeviceTarget> make_target(std::uint32_t points, std::uint32_t shades) const override {
    if (!device_->can_write) throw DeviceError("this picture is drawn by another card");
    return std::make_unique<FakeTarget>(device_, points, shades);
  }
  void write(DeviceTarget& target, Vec2<double> origin) const override {
    if (!device_->can_write) throw DeviceError("the buffers cannot be mapped");
    ++device_->writes;
    const auto& buffers = dynamic_cast<FakeTarget&>(target);
    const std::vector<Vec2<float>> points = points_from(origin);
    device_->fill(buffers.point_buffer, std::as_bytes(std::span(points)));
    device_->fill(buffers.shade_buffer, std::as_bytes(std::span(shades_)));
  }
  void download(std::span<Vec2<float>> to, std::span<float> shades, Vec2<double> origin) const override {
    if (!device_->can_download) throw DeviceError("the device was lost");
    ++device_->downloads;
    std::ranges::copy(points_from(origin), to.begin());
    std::ranges::copy(shades_, shades.begin());
  }
  [[nodiscard]] std::vector<Vec3> positions(std::span<const Index> vertices) const override {
    if (!device_->can_tell_positions) throw DeviceError("the device was lost");
    std::vector<Vec3> told;
    for (const Index v : vertices) told.push_back(positions_.at(v));
    device_->positions_told += told.size();
    return told;
  }
  [[nodiscard]] std::uint64_t bytes_to_host() const noexcept override { return device_->positions_told * sizeof(Vec3); }

 private:
  [[nodiscard]] std::vector<Vec2<float>> points_from(Vec2<double> origin) const {
    std::vector<Vec2<float>> points;
    for (const Vec3& position : positions_) {
      const Vec2<double> point = input_->geometry.plane.project(position) - origin;
      points.push_back({static_cast<float>(point.x), static_cast<float>(point.y)});
    }
    return points;
  }
  std::shared_ptr<FakePictureDevice> device_;
  std::shared_ptr<const InputMesh> input_;
  std::vector<Vec3> positions_;
  std::vector<float> shades_;
  ElementSummary summary_;
};

/// A frame with all values of every vertex and element in `whole`, moved to the device.
inline std::shared_ptr<Frame> light_frame(const Frame& whole, const std::shared_ptr<FakePictureDevice>& device) {
  auto light = std::make_shared<Frame>(whole);
  light->device = std::make_shared<FakePicture>(device, whole.input, whole.positions, whole.shown);
  light->positions.clear();
  light->quality.clear();
  light->inverted.clear();
  light->now = light->device->summary().histogram;
  light->shown_statistics = light->device->summary().statistics;
  light->worst = light->device->summary().worst;
  return light;
}

/// A frame of a mesh with all of it on the host, as FrameBuilder makes it.
inline std::shared_ptr<Frame> whole_frame(std::shared_ptr<const InputMesh> input, std::vector<Vec3> positions, Metric shown,
                                          std::uint64_t serial, std::uint64_t input_serial) {
  auto frame = std::make_shared<Frame>();
  frame->serial = serial;
  frame->input_serial = input_serial;
  frame->input = std::move(input);
  frame->shown = shown;
  frame->positions = std::move(positions);
  const QualityContext context = frame->input->quality_context();
  std::vector<double> quality(frame->input->mesh.elements.size());
  element_qualities(context, frame->positions, shown, nullptr, quality);
  frame->quality.assign(quality.begin(), quality.end());
  for (Index e = 0; e < quality.size(); ++e) frame->inverted.push_back(smallest_jacobian(context, frame->positions, e) <= 0.0 ? 1 : 0);
  frame->shown_statistics = compute_statistics(context, frame->positions, shown, std::span<const Index>{}, nullptr);
  frame->statistics = frame->shown_statistics;
  frame->now = make_histogram(quality);
  frame->worst = worst_elements(quality, 100);
  for (RankedElement& ranked : frame->worst) ranked.inverted = frame->inverted[ranked.element] != 0;
  return frame;
}

}  // namespace dmoscope::testing
