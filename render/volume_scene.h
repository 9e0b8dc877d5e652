#pragma once
// A volume mesh on the OpenGL side, and its visible part: topology is uploaded once, positions and qualities in place, faces when another
// part is seen.

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

/// Scene of a mesh in space. In addition to the functions of Scene:
class VolumeScene final : public Scene {
 public:
  VolumeScene();
  ~VolumeScene() override;

  /// Shows a frame. The view stays, also when another mesh comes. A device-resident frame (one whose positions stay on a device) is not
  /// shown: the picture stays, and the result is false.
  bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) override;

  /// Shows all of another mesh, without a session; update() then brings its positions. Both must live until the next call; `owner` is kept
  /// until then. Throws UsageError when an element is not of a volume.
  void set_mesh(const ElementTable& elements, const FaceNeighbours& faces, std::shared_ptr<const void> owner = {});
  /// Takes positions and qualities. The data that `state` views must live until the next call or another mesh; `owner` is kept until then.
  /// Uploads both in place; faces only where a view depends on these. Throws UsageError for sizes that do not fit.
  void update(const CellState& state, std::shared_ptr<const void> owner = {});
  /// Chooses the visible part; the same view again costs nothing. Throws UsageError, see VisibleCells; the part seen before then stays.
  void set_view(const ClippingView& view);
  /// Sets the threads for finding the visible part; null: the caller's alone.
  void set_pool(ThreadPool* pool) noexcept;

  [[nodiscard]] bool empty() const noexcept override;
  /// Visible part: faces, cuts, number of cells.
  [[nodiscard]] const ClippedFaces& faces() const noexcept;
  [[nodiscard]] std::size_t drawn_count() const noexcept override { return faces().faces.size(); }
  [[nodiscard]] bool sees_element(Index cell) const override;
  [[nodiscard]] bool sees_vertex(Index vertex) const override;
  [[nodiscard]] bool shows_element(const Camera& camera, Vec2<double> viewport, Index cell) const override;
  [[nodiscard]] std::optional<Unhidden> unhidden(const Camera& camera, Vec2<double> viewport) const override;
  /// Bounds of all vertices of elements, visible or not.
  [[nodiscard]] const Bounds3& bounds() const noexcept;
  /// Moves a camera so that it shows all of the mesh, as large as can be within that part of a viewport; see OrbitCamera::fit.
  void fit(OrbitCamera& camera, Vec2<double> viewport, const PicturePart& room) const;

  /// Element of the nearest face or cut at `pixel`, and the nearest of its corners within `radius`; if there is no element, the nearest
  /// vertex of a visible face. Takes some 10 ns per face.
  [[nodiscard]] Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const override;
  /// The point of the mesh that is seen at `pixel`, to orbit about; none when there is nothing.
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
