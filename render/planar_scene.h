#pragma once
// A planar mesh on the OpenGL side: its topology is uploaded once, its positions and qualities again whenever they change.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/plane.h"
#include "render/scene.h"

namespace dmoscope::render {

/// Origin of the positions and colours on show.
enum class Source {
  Host,        // the frame has them
  Device,      // the device that has them wrote them itself
  HostCopy,    // the device's data came through the host, see PlanarScene::device_trouble
  Unreachable  // the device tells nothing any more, and no element is drawn
};

/// Scene of a planar mesh. In addition to the functions of Scene:
class PlanarScene final : public Scene {
 public:
  PlanarScene();
  ~PlanarScene() override;

  /// Shows a frame. The device writes positions and qualities of a device-resident frame, or when that fails they come through the host
  /// until another mesh is shown. With Loading::Background the ordering of a big new mesh is done on a thread of its own, and the scene
  /// shows nothing of it until a later call.
  bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) override;

  /// Brings what lives on a device through the host from now on; `why`: for device_trouble(), empty: no longer.
  void draw_through_host(std::string why);

  /// Shows a mesh without a session; update() then brings its positions. Elements of `mesh` must be triangles and quadrilaterals (else
  /// UsageError); the mesh is not kept.
  void set_mesh(const Mesh& mesh, const Plane& plane);
  /// Replaces positions and qualities. positions: one per vertex. quality and inverted: one per element, as in Frame; inverted may be empty
  /// (none).
  void update(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted);

  /// Sets which vertices are fixed (RunView::fixed), for Style::vertices; empty: all free. Forgotten when another mesh is shown.
  void set_fixed(std::span<const std::uint8_t> fixed);

  [[nodiscard]] bool empty() const noexcept override;
  [[nodiscard]] Index element_count() const noexcept;
  [[nodiscard]] std::size_t drawn_count() const noexcept override { return element_count(); }
  /// Box of the vertices used by elements, in the plane; empty when nothing is shown. It belongs to the positions shown last, or, while
  /// light frames are shown, to those that were last on the host.
  [[nodiscard]] const Bounds2& bounds() const noexcept;
  [[nodiscard]] Source source() const noexcept;
  /// Reason why data on a device is drawn through the host, or not at all; empty when nothing prevents drawing it there.
  [[nodiscard]] const std::string& device_trouble() const noexcept;

  /// Element and vertex under `pixel`. Takes milliseconds even for millions of elements; once per device-resident frame as long as it takes
  /// to bring all of it to the host. Finds nothing when the device does not give it.
  [[nodiscard]] Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const override;
  /// All vertices of elements within `radius` pixels of `pixel`, ascending; at the cost of pick().
  [[nodiscard]] std::vector<Index> vertices_near(const Camera2D& camera, Vec2<double> viewport, Vec2<double> pixel, double radius) const;
  /// Vertices and edges in view, and some around the view.
  [[nodiscard]] std::optional<Unhidden> unhidden(const Camera& camera, Vec2<double> viewport) const override;

 private:
  struct Impl;
  class PlanarPass;
  [[nodiscard]] std::unique_ptr<Pass> pass(const Camera& camera, const Style& style, Vec2<double> viewport,
                                           const PicturePart& part) override;
  [[nodiscard]] SceneView view_of(const Camera& camera, Vec2<double> viewport, const PicturePart& part) const override;
  [[nodiscard]] const ElementTable* elements() const override;
  [[nodiscard]] Index vertex_count() const override;
  [[nodiscard]] std::vector<Vec3> places_of(std::span<const Corner> corners) const override;
  void visit_shown(const Camera& camera, Vec2<double> viewport, const VisitPolygon& visit) const override;
  [[nodiscard]] Index value_count(Shading::By by) const override;
  [[nodiscard]] Fill& fill() noexcept override;
  /// Gathers dots on the vertices of elements in `window` that are big enough, each once.
  void gather_vertices(const SceneView& view, const Style& style, const Bounds2& window);
  /// Whether the selection hides an element; only valid while the placement is current.
  [[nodiscard]] bool hides(Index element) const;
  /// Calls visit(element) for all that are not hidden in blocks that meet `window`, in the order in which they are drawn.
  template <class Visit>
  void for_elements(const Bounds2& window, Visit&& visit) const;

  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope::render
