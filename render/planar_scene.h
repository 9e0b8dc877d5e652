#pragma once
// A planar mesh on the OpenGL side: its topology once, its positions and qualities again whenever they change.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/plane.h"
#include "render/scene.h"

namespace dmoscope::render {

/// How the positions and colours on show came to OpenGL.
enum class Source {
  Host,        // the frame had them
  Device,      // the device that has them wrote them itself
  HostCopy,    // the same through the host, see PlanarScene::device_trouble
  Unreachable  // not at all: the device tells nothing any more, and no element is drawn
};

/// Draws and picks. Needs a current context in every member function but pick, bounds and the other questions.
class PlanarScene final : public Scene {
 public:
  PlanarScene();
  ~PlanarScene() override;
  PlanarScene(PlanarScene&&) noexcept;
  PlanarScene& operator=(PlanarScene&&) noexcept;

  /// Shows a frame: uploads topology when frame->input_serial differs from the last one's, positions and qualities in place when
  /// frame->serial does; otherwise costs nothing. Those of a device-resident frame are written by its device, or where that fails brought
  /// through the host, from then on until another mesh is shown. Null shows nothing. With Loading::Background the ordering of a big new
  /// mesh is done on a thread of its own, and the scene shows nothing of it until a later call. Returns whether `frame` is on show now.
  bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) override;

  /// What lives on a device is brought through the host from now on; `why`: for device_trouble(), empty: no longer.
  void draw_through_host(std::string why);

  /// The same in two steps, for meshes without a session. Elements of `mesh` must be triangles and quadrilaterals (else
  /// UsageError); the mesh is not kept.
  void set_mesh(const Mesh& mesh, const Plane& plane);
  /// positions: one per vertex. quality and inverted: one per element, as in Frame; inverted may be empty (none).
  void update(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted);

  /// Which vertices are fixed (RunView::fixed), for Style::vertices; empty: all free. Forgotten when another mesh is shown.
  void set_fixed(std::span<const std::uint8_t> fixed);

  void set_shading(std::shared_ptr<const Shading> shading) override;
  void set_selection(const Selection& selection) override;

  [[nodiscard]] std::uint64_t revision() const noexcept override;
  [[nodiscard]] bool empty() const noexcept override;
  [[nodiscard]] Index element_count() const noexcept;
  [[nodiscard]] std::size_t drawn_count() const noexcept override { return element_count(); }
  /// Box of the vertices used by elements, in the plane; empty when nothing is shown. That of the positions shown last, or while light
  /// frames are shown of those that were last on the host.
  [[nodiscard]] const Bounds2& bounds() const noexcept;
  [[nodiscard]] Source source() const noexcept;
  /// Why what lives on a device is drawn through the host, or not at all; empty when nothing speaks against drawing it there.
  [[nodiscard]] const std::string& device_trouble() const noexcept;

  /// Clears `target` and draws all of it. detail in (0, 1]: below 1, when more than that share of the elements is in view, each
  /// of an evenly spread subset stands for its neighbours as a small square (a group with an inverted element shows it),
  /// and the wireframe is left out: the same picture for the same detail, coarser. Throws Error.
  void draw(Framebuffer& target, const Camera2D& camera, const Style& style, const Marks& marks = {}, double detail = 1.0);

  bool draw_elements(Framebuffer& target, const Camera& camera, const Style& style, double detail = 1.0) override;
  void draw_marks(Framebuffer& target, const Camera& camera, const Style& style, const SceneMarks& marks) override;
  bool draw_slice(Framebuffer& target, const Camera& camera, const Style& style, SliceProgress& progress, Index most) override;
  void draw_part(Framebuffer& target, const Camera& camera, const Style& style, const SceneMarks& marks, Vec2<double> viewport,
                 const PicturePart& part) override;

  /// Milliseconds even for millions of elements; of a device-resident frame once a frame as long as it takes to bring all of it to the
  /// host, and nothing when the device does not give it.
  [[nodiscard]] Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const override;
  /// All vertices of elements within `radius` pixels of `pixel`, ascending; at the cost of pick().
  [[nodiscard]] std::vector<Index> vertices_near(const Camera2D& camera, Vec2<double> viewport, Vec2<double> pixel, double radius) const;
  /// The elements in view and some around it, in no order; none when they are more than `most`, or stand on a device.
  [[nodiscard]] std::optional<std::vector<Index>> elements_in_view(const Camera2D& camera, Vec2<double> viewport, std::size_t most) const;

  /// The ids that have space in a viewport of that size: of an element inside of it, of a vertex between it and its neighbours. None when
  /// there are more than wish.most, and none while too much is in view to look at it all.
  [[nodiscard]] std::vector<Label> labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope::render
