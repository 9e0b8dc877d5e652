#pragma once
// Parts of a planar scene. Only for its own sources.

#include <array>
#include <future>
#include <memory>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "render/device_feed.h"
#include "render/draw_order.h"
#include "render/element_painter.h"
#include "render/planar_scene.h"

namespace dmoscope::render {

struct PlanarScene::Impl {
  Placement placement;
  bool placement_current = true;  // false: the positions on show are on a device, and the placement is older
  Source source = Source::Host;
  ElementPainter elements;
  DeviceFeed device;  // declared after the painter, whose buffers it knows
  std::vector<std::uint8_t> fixed;
  std::vector<float> shades;           // one per element, see shade_of; of the same state as the placement
  std::shared_ptr<const Frame> frame;  // the frame on show
  std::uint64_t input_serial = 0;
  bool has_input = false;
  std::future<std::shared_ptr<const Layout>> pending;
  std::uint64_t pending_serial = 0;
  std::shared_ptr<const InputMesh> pending_input;

  bool is_new = false;  // the placement is new: shading and selection still belong to another mesh
  void adopt(std::shared_ptr<const Layout> layout) {
    device.forget_buffers();
    elements.upload_topology(*layout);
    placement = Placement(std::move(layout));
    fixed.clear();
    shades.clear();
    is_new = true;
  }
  bool prepare(const Frame& wanted, Loading loading);
  [[nodiscard]] bool stands_at(const Frame& wanted) const;
  void upload_points(std::span<const Vec3> positions);
  void upload_shades(std::span<const float> quality, std::span<const std::uint8_t> inverted_flags);
  void upload(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted_flags);
  void show_device(const Frame& light);
  /// Brings the placement up to date with what is on show. Throws DeviceError.
  void place_all();
  /// Positions of some vertices in the plane. Throws DeviceError.
  [[nodiscard]] std::vector<Vec2<double>> points_of(std::span<const Index> vertices) const;
  [[nodiscard]] std::vector<DrawRange> visible(std::size_t batch, const Bounds2& window) const;
  struct InView {
    std::array<std::vector<DrawRange>, 2> ranges;
    Index count = 0;
  };
  [[nodiscard]] InView in_view(const Bounds2& window) const;
  /// Whether positions on show can be looked up on the host; brings them there if need be.
  [[nodiscard]] bool is_known();
};

template <class Visit>
void PlanarScene::for_elements(const Bounds2& window, Visit&& visit) const {
  const Layout& layout = impl_->placement.layout();
  for (std::size_t batch = 0; batch < layout.batches.size(); ++batch)
    for (const DrawRange& range : impl_->placement.visible(batch, window))
      for (Index drawn = range.first; drawn < range.last; ++drawn)
        if (const Index element = layout.batches[batch].order[drawn]; !hides(element)) visit(element);
}

}  // namespace dmoscope::render
