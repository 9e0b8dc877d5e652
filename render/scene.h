#pragma once
// Common interface of all meshes on the OpenGL side, planar or volume: shown, coloured, drawn in one go or bit by bit, and picked from.

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/mesh.h"
#include "core/view/view.h"
#include "render/framebuffer.h"
#include "render/marks.h"
#include "render/scene_view.h"
#include "render/shading.h"
#include "render/style.h"

namespace dmoscope::render {

class Fill;
class MarkPainter;

/// Element and vertex under a pixel.
struct Pick {
  Index element = kNoIndex;      // the one drawn on top there; inverted elements lie above the others
  Index vertex = kNoIndex;       // the nearest within the radius
  double vertex_distance = 0.0;  // pixels; meaningful when there is a vertex
};

/// An id to be written, where there is space for it.
struct Label {
  Vec2<double> point;  // middle of the text: pixels from the middle of the viewport, y up
  Index id = kNoIndex;
  bool vertex = false;  // whether the id is a vertex's; else an element's
};
struct LabelWish {
  bool vertices = false, elements = false;
  double digit_width = 8.0, line_height = 15.0;  // size of the text, in pixels
  std::size_t most = 400;                        // if there would be more, none are shown
};

/// Visible part that nothing hides: its vertices, ascending, and the edges between two of them, low end first, ascending, each once.
struct Unhidden {
  std::vector<Index> vertices;
  std::vector<std::array<Index, 2>> edges;
  /// Sorts both and removes duplicates.
  void tidy() {
    const auto tidy_one = [](auto& list) {
      std::ranges::sort(list);
      list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    tidy_one(vertices);
    tidy_one(edges);
  }
};

/// Progress of a picture that is drawn in slices.
struct SliceProgress {
  bool begun = false;
  Index drawn = 0;  // elements in view that are done
};

/// Whether to wait until a big mesh is ready for drawing.
enum class Loading { Wait, Background };

/// A mesh that is drawn. Functions that take a camera throw std::bad_variant_access for the camera of the other kind of mesh. Constructors
/// and functions that draw or upload need a current context.
class Scene {
 public:
  virtual ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Shows a frame: topology when frame->input_serial differs from the last one's, positions and qualities in place when frame->serial
  /// does; otherwise costs nothing. Null shows nothing. Returns whether `frame` is on show now.
  virtual bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) = 0;
  /// Sets values to show instead of quality; null: quality. Forgotten when another mesh is shown. Throws UsageError for other than one
  /// value per element or, of a planar mesh, vertex.
  void set_shading(std::shared_ptr<const Shading> shading);
  /// Sets which elements count; forgotten when another mesh is shown. Throws UsageError when the members are not as many as the elements.
  void set_selection(const Selection& selection);

  /// Number that grows with every change of the picture, except by camera, style and marks.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  [[nodiscard]] virtual bool empty() const noexcept = 0;
  /// Number of elements, or faces, to draw.
  [[nodiscard]] virtual std::size_t drawn_count() const noexcept = 0;
  /// Share of `count` of them worth drawing, (0, 1]: 1 except on software OpenGL while something moves (a drag, a run that is drawn live),
  /// where it is what keeps a frame below about 100 ms.
  [[nodiscard]] double suggested_detail(std::size_t count, bool is_software, bool moving) const noexcept {
    return is_software && moving && count > 0 ? std::min(1.0, affordable_ / static_cast<double>(count)) : 1.0;
  }

  /// Calls draw_elements, then draw_marks.
  void draw(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks = {}, double detail = 1.0);
  /// Clears `target` and draws all but the marks. detail in (0, 1]: below 1, when more than that share of the elements is in view, each of
  /// an evenly spread subset stands for its neighbours as a small square, and lines are left out: the same picture for the same detail,
  /// coarser. Returns whether all in view was drawn. Throws Error.
  bool draw_elements(Framebuffer& target, const Camera& camera, const Style& style, double detail = 1.0);
  /// Draws marks over the elements.
  void draw_marks(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks);
  /// Does the work of draw_elements at full detail, bit by bit: at most `most` elements more, and waits until they are drawn. Camera, style
  /// and revision() must be those of the slices before. Returns whether it was the last slice. Throws Error.
  bool draw_slice(Framebuffer& target, const Camera& camera, const Style& style, SliceProgress& progress, Index most);
  /// Draws all at full detail: the picture is `viewport` pixels large, and the target gets that part of it. Throws Error.
  void draw_part(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks, Vec2<double> viewport,
                 const PicturePart& part);

  /// Maps the scene's points to a viewport of that size.
  [[nodiscard]] SceneView view(const Camera& camera, Vec2<double> viewport) const { return view_of(camera, viewport, {{0, 0}, viewport}); }
  /// Element and vertex at `pixel` (of a viewport of that size), by geometry in double, not by colours. `radius`: how far a vertex may be,
  /// in pixels.
  [[nodiscard]] virtual Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const = 0;
  /// Ids that have space in a viewport of that size: an element's within it or one of its faces, a vertex's between it and its neighbours;
  /// only where nothing hides them and there is no other id. None when there are more than wish.most, or too much is in view to look at it
  /// all.
  [[nodiscard]] std::vector<Label> labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish) const;
  /// Vertices and edges that nothing hides; none while there is more in view than can be looked through in a moment.
  [[nodiscard]] virtual std::optional<Unhidden> unhidden(const Camera& camera, Vec2<double> viewport) const = 0;
  /// Whether an element, or some element around a vertex, is seen: not taken away, though others may hide it. True when a vertex has no
  /// element.
  [[nodiscard]] virtual bool sees_element(Index /*element*/) const { return true; }
  [[nodiscard]] virtual bool sees_vertex(Index /*vertex*/) const { return true; }
  /// Whether some part of an element is in the picture: not taken away, and not behind others. True while there is more in view than can be
  /// looked through in a moment.
  [[nodiscard]] virtual bool shows_element(const Camera& /*camera*/, Vec2<double> /*viewport*/, Index /*element*/) const { return true; }

 protected:
  /// `affordable`: number of elements or faces that llvmpipe on two cores draws, coarsely, well within 100 ms.
  explicit Scene(double affordable);

  /// The drawing of a picture, or of a part of one.
  class Pass {
   public:
    virtual ~Pass() = default;
    [[nodiscard]] virtual Index count() const = 0;  // elements or faces to be drawn
    virtual void begin() {}                         // draws everything that the others are blended with
    virtual void draw(Index first, Index count) = 0;
    /// Draws a square for one of every `stride` elements or faces.
    virtual void draw_coarse(Index stride) = 0;
    /// Draws marks of the mesh over the elements; `whole`: all of these were drawn at full detail.
    virtual void end(Framebuffer& target, bool whole) = 0;
  };
  /// Starts a picture; null when there is nothing to draw. Everything it refers to must outlive it.
  [[nodiscard]] virtual std::unique_ptr<Pass> pass(const Camera& camera, const Style& style, Vec2<double> viewport,
                                                   const PicturePart& part) = 0;
  [[nodiscard]] virtual SceneView view_of(const Camera& camera, Vec2<double> viewport, const PicturePart& part) const = 0;
  /// Number of pixels beyond the borders of a part of a picture that must be drawn for it to fit its neighbours.
  [[nodiscard]] virtual int reach(const Style& /*style*/, Vec2<double> /*viewport*/) const { return 0; }

  /// A vertex as a corner of an element; with kNoIndex as element, the vertex by itself.
  struct Corner {
    Index element, vertex;
  };
  /// Elements of the mesh; null when no positions are known.
  [[nodiscard]] virtual const ElementTable* elements() const = 0;
  [[nodiscard]] virtual Index vertex_count() const = 0;
  /// Points of the scene at which corners are drawn; those of an element stand together. Throws DeviceError.
  [[nodiscard]] virtual std::vector<Vec3> places_of(std::span<const Corner> corners) const = 0;

  /// Calls visit(element, polygon) for the visible polygons of elements, in points of the scene. For none when there are too many.
  using VisitPolygon = std::function<void(Index, std::span<const Vec3>)>;
  virtual void visit_shown(const Camera& camera, Vec2<double> viewport, const VisitPolygon& visit) const = 0;

  /// Number of values that a shading must have; kNoIndex: such a shading is not possible.
  [[nodiscard]] virtual Index value_count(Shading::By by) const = 0;
  [[nodiscard]] virtual Fill& fill() noexcept = 0;
  [[nodiscard]] MarkPainter& painter() noexcept { return *painter_; }
  [[nodiscard]] const Selection& selection() const noexcept { return selection_; }
  void changed() noexcept { ++revision_; }
  /// Forgets shading and selection, which belonged to the mesh before.
  void forget_look() {
    shading_.reset();
    selection_ = {};
    changed();
  }

 private:
  void gather(const SceneView& view, const Style& style, const Marks& wanted);
  void gather_of_mesh(const SceneView& view, const Style& style, const Marks& wanted);
  void add_element_labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish, std::vector<Label>& labels) const;
  void add_vertex_labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish, std::vector<Label>& labels) const;
  void put_marks(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks, Vec2<double> viewport,
                 const PicturePart& part);
  void draw_whole(Framebuffer& target, const Camera& camera, const Style& style, Vec2<double> viewport, const PicturePart& part);

  double affordable_;
  std::unique_ptr<MarkPainter> painter_;
  std::optional<Framebuffer> wider_;  // wider than the part of a picture that is drawn
  std::shared_ptr<const Shading> shading_;
  Selection selection_;
  std::uint64_t revision_ = 0;
};

}  // namespace dmoscope::render
