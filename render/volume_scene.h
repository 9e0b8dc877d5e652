#pragma once
// A volume mesh on the OpenGL side, and what is seen of it: topology once, positions and qualities in place, faces when another part is
// seen.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/clipping/clipping.h"
#include "render/framebuffer.h"
#include "render/orbit_camera.h"
#include "render/scene.h"
#include "render/style.h"

namespace dmoscope::render {

/// A mesh in space. Besides what Scene says:
class VolumeScene final : public Scene {
 public:
  VolumeScene();
  ~VolumeScene() override;

  /// The view stays, also when another mesh comes. A device-resident frame (one whose positions stay on a device) is not shown: what was on
  /// show stays, and false comes back.
  bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) override;

  /// The same in two steps, for meshes without a session. Shows another mesh, all of it. Both must live until the next call; `owner` is
  /// kept until then. Throws UsageError when an element is not of a volume.
  void set_mesh(const ElementTable& elements, const FaceNeighbours& faces, std::shared_ptr<const void> owner = {});
  /// Takes positions and qualities. What `state` views must live until the next call or another mesh; `owner` is kept until then. Uploads
  /// both in place; faces only where a view depends on these. Throws UsageError for sizes that do not fit.
  void update(const CellState& state, std::shared_ptr<const void> owner = {});
  /// Chooses what is seen; the same view again costs nothing. Throws UsageError, see VisibleCells; what was seen before is seen then.
  void set_view(const ClippingView& view);
  /// Threads for finding what is seen; null: the caller's alone.
  void set_pool(ThreadPool* pool) noexcept;

  [[nodiscard]] bool empty() const noexcept override;
  /// What is seen: faces, cuts, number of cells.
  [[nodiscard]] const ClippedFaces& faces() const noexcept;
  [[nodiscard]] std::size_t drawn_count() const noexcept override { return faces().faces.size(); }
  [[nodiscard]] bool sees_element(Index cell) const override;
  [[nodiscard]] bool sees_vertex(Index vertex) const override;
  [[nodiscard]] bool shows_element(const Camera& camera, Vec2<double> viewport, Index cell) const override;
  [[nodiscard]] std::optional<Unhidden> unhidden(const Camera& camera, Vec2<double> viewport) const override;
  /// Bounds of all vertices of elements, visible or not.
  [[nodiscard]] const Bounds3& bounds() const noexcept;
  /// Moves a camera so that it shows all of these, as large as can be within that part of a viewport; see OrbitCamera::fit.
  void fit(OrbitCamera& camera, Vec2<double> viewport, const PicturePart& room) const;

  /// The element of the nearest face or cut there, and of its corners the nearest within `radius`; of an empty place the nearest vertex of
  /// a visible face. Some 10 ns per face.
  [[nodiscard]] Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const override;
  /// The point of the mesh that is seen at `pixel`, to orbit about; none where nothing is.
  [[nodiscard]] std::optional<Vec3> point_at(const OrbitCamera& camera, Vec2<double> viewport, Vec2<double> pixel) const;

 private:
  struct Impl;
  class VolumePass;
  [[nodiscard]] std::unique_ptr<Pass> pass(const Camera& camera, const Style& style, Vec2<double> viewport,
                                           const PicturePart& part) override;
  [[nodiscard]] SceneView view_of(const Camera& camera, Vec2<double> viewport, const PicturePart& part) const override;
  [[nodiscard]] int reach(const Style& style, Vec2<double> viewport) const override;
  [[nodiscard]] const ElementTable* elements() const override;
  [[nodiscard]] Index vertex_count() const override;
  [[nodiscard]] std::vector<Vec3> places_of(std::span<const Corner> corners) const override;
  void visit_shown(const Camera& camera, Vec2<double> viewport, const VisitPolygon& visit) const override;
  [[nodiscard]] Index value_count(Shading::By by) const override;
  [[nodiscard]] Fill& fill() noexcept override;

  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope::render
