#pragma once
// The parts of a scene. Only for its own sources.

#include <array>
#include <future>
#include <memory>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "render/device_feed.h"
#include "render/draw_order.h"
#include "render/element_painter.h"
#include "render/mark_painter.h"
#include "render/planar_scene.h"

namespace dmoscope::render {

struct PlanarScene::Impl {
  Placement placement;
  bool placement_current = true;  // false: what is on show stands on a device, and the placement is an older one's
  Source source = Source::Host;
  ElementPainter elements;
  DeviceFeed device;  // after the painter, whose buffers it knows
  MarkPainter marks;
  std::vector<std::uint8_t> fixed;
  std::vector<float> shades;  // one per element, see shade_of; as old as the placement
  std::shared_ptr<const Shading> shading;
  Selection selection;
  std::uint64_t revision = 0;
  std::shared_ptr<const Frame> frame;  // the one on show
  std::uint64_t input_serial = 0;
  bool has_input = false;
  std::future<std::shared_ptr<const Layout>> pending;
  std::uint64_t pending_serial = 0;
  std::shared_ptr<const InputMesh> pending_input;

  void adopt(std::shared_ptr<const Layout> layout) {
    device.forget_buffers();
    elements.upload_topology(*layout);
    placement = Placement(std::move(layout));
    fixed.clear();
    shades.clear();
    shading.reset();
    selection = {};
    ++revision;
  }
  bool prepare(const Frame& wanted, Loading loading);
  [[nodiscard]] bool stands_at(const Frame& wanted) const;
  void upload_points(std::span<const Vec3> positions);
  void upload_shades(std::span<const float> quality, std::span<const std::uint8_t> inverted_flags);
  void upload(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted_flags);
  void show_device(const Frame& light);
  /// Brings the placement up to date with what is on show. Throws DeviceError.
  void place_all();
  /// Where some vertices are in the plane. Throws DeviceError.
  [[nodiscard]] std::vector<Vec2<double>> points_of(std::span<const Index> vertices) const;
  [[nodiscard]] std::vector<DrawRange> visible(std::size_t batch, const Bounds2& window) const;
  struct InView {
    std::array<std::vector<DrawRange>, 2> ranges;
    Index count = 0;
  };
  [[nodiscard]] InView in_view(const Bounds2& window) const;
  /// Everything that lies over the elements and under the marks.
  void draw_over(const View& view, const Camera2D& camera, const Style& style, const Bounds2* vertices_of);
  /// Asks the selection; only where the placement is current.
  [[nodiscard]] bool counts(Index element) const {
    if (selection.members && (*selection.members)[element] == 0) return false;
    return !selection.quality || element >= shades.size() || in_quality_range(*selection.quality, shades[element]);
  }
  [[nodiscard]] bool hidden(Index element) const { return selection.others == Selection::Others::Hide && !counts(element); }
  void gather_mesh_marks(const Camera2D& camera, const Style& style, const Marks& wanted);
  void gather_marks(const Camera2D& camera, const Style& style, const Marks& wanted);
  void gather_vertices(const Camera2D& camera, const Style& style, const Bounds2& window);
  void outline(std::span<const Vec2<double>> corners, const Camera2D& camera, const Style& style);
  /// Pixels from the middle of the viewport, y up.
  [[nodiscard]] static Vec2<double> place(Vec2<double> point, const Camera2D& camera) {
    return {(point.x - camera.centre.x) / camera.units_per_pixel, (point.y - camera.centre.y) / camera.units_per_pixel};
  }
};

}  // namespace dmoscope::render
