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

/// The visible part that nothing hides: its vertices, ascending, and the edges between two of them, each once.
struct Unhidden {
  std::vector<Index> vertices;
  std::vector<std::array<Index, 2>> edges;
};

/// Draws and picks. Only draw() and what uploads (set_mesh, update, set_view, set_shading) need a current context.
class VolumeScene final : public Scene {
 public:
  VolumeScene();
  ~VolumeScene() override;
  VolumeScene(VolumeScene&&) noexcept;
  VolumeScene& operator=(VolumeScene&&) noexcept;

  /// Shows a frame as PlanarScene does; its input must be a volume. The view stays, also when another mesh comes. A device-resident frame
  /// (one whose positions stay on a device) is not shown: what was on show stays, and false comes back.
  bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) override;

  /// The same in two steps, for meshes without a session. Shows another mesh, all of it. Both must live until the next call; `owner` is
  /// kept until then. Throws UsageError when an element is not of a volume.
  void set_mesh(const ElementTable& elements, const FaceNeighbours& faces, std::shared_ptr<const void> owner = {});
  /// Takes positions and qualities. What `state` views must live until the next call or another mesh; `owner` is kept until then. Uploads
  /// both in place; faces only where a view depends on these. Throws UsageError for sizes that do not fit.
  void update(const CellState& state, std::shared_ptr<const void> owner = {});
  /// Chooses what is seen; the same view again costs nothing. Throws UsageError, see VisibleCells; what was seen before is seen then.
  void set_view(const ClippingView& view);
  [[nodiscard]] const ClippingView& view() const noexcept;
  /// Shown instead of quality, by elements; null: quality. Forgotten with another mesh. Throws UsageError unless there is one value
  /// per element.
  void set_shading(std::shared_ptr<const Shading> shading) override;
  /// Cells that do not count are faded, or hidden as far as faces are drawn; what takes cells away is the view. Forgotten with another
  /// mesh. Throws UsageError when the members are not as many as the elements.
  void set_selection(const Selection& selection) override;
  /// Threads for finding what is seen; null: the caller's alone.
  void set_pool(ThreadPool* pool) noexcept;

  [[nodiscard]] bool empty() const noexcept override;
  [[nodiscard]] std::uint64_t revision() const noexcept override;
  /// What is seen: faces, cuts, number of cells.
  [[nodiscard]] const ClippedFaces& faces() const noexcept;
  [[nodiscard]] std::size_t drawn_count() const noexcept override { return faces().faces.size(); }
  /// Whether a cell, or some cell around a vertex, is seen: not taken away, though others may hide it. True where there is none such.
  [[nodiscard]] bool sees_cell(Index cell) const;
  [[nodiscard]] bool sees_vertex(Index vertex) const;
  /// Whether something of a cell is in the picture: not taken away, and not behind others. True while more faces are drawn than can be
  /// looked through in a moment.
  [[nodiscard]] bool shows_cell(const OrbitCamera& camera, Vec2<double> viewport, Index cell) const;
  /// None while more faces are drawn than can be looked through in a moment.
  [[nodiscard]] std::optional<Unhidden> unhidden(const OrbitCamera& camera, Vec2<double> viewport) const;
  /// The ids that have space in a viewport of that size: of a cell within one of its faces, of a vertex between it and its neighbours,
  /// where nothing hides them and no other stands. Their points are in pixels from the middle of the viewport, y up. None when they are
  /// more than wish.most, and none while there are too many faces.
  [[nodiscard]] std::vector<Label> labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish) const override;
  /// Bounds of all vertices of elements, visible or not.
  [[nodiscard]] const Bounds3& bounds() const noexcept;
  /// Moves a camera so that it shows all of these, as large as can be within that part of a viewport; see OrbitCamera::fit.
  void fit(OrbitCamera& camera, Vec2<double> viewport, const PicturePart& room) const;

  /// Clears `target` and draws. `detail` in (0, 1]: below 1 a square stands for each of that share of the faces and its neighbours. Throws
  /// Error.
  void draw(Framebuffer& target, const OrbitCamera& camera, const Style& style, const SpaceMarks& marks = {}, double detail = 1.0);
  bool draw_elements(Framebuffer& target, const Camera& camera, const Style& style, double detail = 1.0) override;
  void draw_marks(Framebuffer& target, const Camera& camera, const Style& style, const SceneMarks& marks) override;
  bool draw_slice(Framebuffer& target, const Camera& camera, const Style& style, SliceProgress& progress, Index most) override;
  void draw_part(Framebuffer& target, const Camera& camera, const Style& style, const SceneMarks& marks, Vec2<double> viewport,
                 const PicturePart& part) override;

  /// What lies at `pixel`: the element of the nearest face or cut there, and of its corners the nearest within `radius`; of
  /// an empty place the nearest vertex of a visible face. By geometry in double. Some 10 ns per face.
  [[nodiscard]] Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const override;
  /// The point of the mesh that is seen at `pixel`, to orbit about; none where nothing is.
  [[nodiscard]] std::optional<Vec3> point_at(const OrbitCamera& camera, Vec2<double> viewport, Vec2<double> pixel) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dmoscope::render
