#pragma once
// What every mesh on the OpenGL side offers, planar or volume: it is shown, coloured, drawn in one go or bit by bit, and picked from.

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

/// What lies under a pixel.
struct Pick {
  Index element = kNoIndex;      // the one drawn on top there; inverted elements lie above the others
  Index vertex = kNoIndex;       // the nearest within the radius
  double vertex_distance = 0.0;  // pixels; meaningful when there is a vertex
};

/// Which ids are to be written, where there is space for them.
struct Label {
  Vec2<double> point;  // where the middle of the text belongs: pixels from the middle of the viewport, y up
  Index id = kNoIndex;
  bool vertex = false;  // else an element
};
struct LabelWish {
  bool vertices = false, elements = false;
  double digit_width = 8.0, line_height = 15.0;  // of the text, pixels
  std::size_t most = 400;                        // where there would be more, none are shown
};

/// The visible part that nothing hides: its vertices, ascending, and the edges between two of them, low end first, ascending, each once.
struct Unhidden {
  std::vector<Index> vertices;
  std::vector<std::array<Index, 2>> edges;
  /// Orders them, and leaves out what is there twice.
  void tidy() {
    const auto tidy_one = [](auto& list) {
      std::ranges::sort(list);
      list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    tidy_one(vertices);
    tidy_one(edges);
  }
};

/// How far a picture that is drawn in slices has come.
struct SliceProgress {
  bool begun = false;
  Index drawn = 0;  // elements in view that are done
};

/// Whether to wait until a big mesh is made ready for drawing.
enum class Loading { Wait, Background };

/// A mesh that is drawn. Functions that take a camera throw std::bad_variant_access for that of the other kind of mesh. What draws, uploads
/// or is constructed needs a current context.
class Scene {
 public:
  virtual ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Shows a frame: topology when frame->input_serial differs from the last one's, positions and qualities in place when frame->serial
  /// does; otherwise costs nothing. Null shows nothing. Returns whether `frame` is on show now.
  virtual bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) = 0;
  /// What is shown instead of quality; null: quality. Forgotten when another mesh is shown. Throws UsageError for other than one value per
  /// element or, of a planar mesh, vertex.
  void set_shading(std::shared_ptr<const Shading> shading);
  /// Which elements count; forgotten when another mesh is shown. Throws UsageError when the members are not as many as the elements.
  void set_selection(const Selection& selection);

  /// Grows with every change of what is drawn, camera, style and marks apart.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  [[nodiscard]] virtual bool empty() const noexcept = 0;
  /// Elements, or faces, there are to draw.
  [[nodiscard]] virtual std::size_t drawn_count() const noexcept = 0;
  /// Share of `count` of them worth drawing, (0, 1]: 1 except on software OpenGL while something moves (a drag, a run that is drawn live),
  /// where it is what keeps a frame below about 100 ms.
  [[nodiscard]] double suggested_detail(std::size_t count, bool is_software, bool moving) const noexcept {
    return is_software && moving && count > 0 ? std::min(1.0, affordable_ / static_cast<double>(count)) : 1.0;
  }

  /// draw_elements and draw_marks.
  void draw(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks = {}, double detail = 1.0);
  /// Clears `target` and draws all but the marks. detail in (0, 1]: below 1, when more than that share of the elements is in view, each of
  /// an evenly spread subset stands for its neighbours as a small square, and lines are left out: the same picture for the same detail,
  /// coarser. Returns whether all in view was drawn. Throws Error.
  bool draw_elements(Framebuffer& target, const Camera& camera, const Style& style, double detail = 1.0);
  /// Draws marks over it.
  void draw_marks(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks);
  /// draw_elements at full detail, bit by bit: at most `most` elements more, and waits until they are drawn. Camera, style and revision()
  /// must be those of the slices before. Returns whether it was the last slice. Throws Error.
  bool draw_slice(Framebuffer& target, const Camera& camera, const Style& style, SliceProgress& progress, Index most);
  /// Draws all at full detail: the picture is `viewport` pixels large, and the target gets that part of it. Throws Error.
  void draw_part(Framebuffer& target, const Camera& camera, const Style& style, const Marks& marks, Vec2<double> viewport,
                 const PicturePart& part);

  /// Where its points are in a viewport of that size.
  [[nodiscard]] SceneView view(const Camera& camera, Vec2<double> viewport) const { return view_of(camera, viewport, {{0, 0}, viewport}); }
  /// What is at `pixel` (of a viewport of that size) by geometry in double, not by colours. `radius`: how far a vertex may be, in pixels.
  [[nodiscard]] virtual Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const = 0;
  /// The ids that have space in a viewport of that size: of an element within it, or one of its faces; of a vertex between it and its
  /// neighbours; where nothing hides them and no other stands. None when there are more than wish.most, or too much is in view to look at
  /// it all.
  [[nodiscard]] std::vector<Label> labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish) const;
  /// None while there is more in view than can be looked through in a moment.
  [[nodiscard]] virtual std::optional<Unhidden> unhidden(const Camera& camera, Vec2<double> viewport) const = 0;
  /// Whether an element, or some element around a vertex, is seen: not taken away, though others may hide it. True where there is none
  /// such.
  [[nodiscard]] virtual bool sees_element(Index /*element*/) const { return true; }
  [[nodiscard]] virtual bool sees_vertex(Index /*vertex*/) const { return true; }
  /// Whether something of an element is in the picture: not taken away, and not behind others. True while there is more in view than can be
  /// looked through in a moment.
  [[nodiscard]] virtual bool shows_element(const Camera& /*camera*/, Vec2<double> /*viewport*/, Index /*element*/) const { return true; }

 protected:
  /// `affordable`: elements or faces that llvmpipe on two cores draws, coarsely, well within 100 ms.
  explicit Scene(double affordable);

  /// A picture, or part of one, while it is drawn.
  class Pass {
   public:
    virtual ~Pass() = default;
    [[nodiscard]] virtual Index count() const = 0;  // elements or faces to be drawn
    virtual void begin() {}                         // draws what the others are blended with
    virtual void draw(Index first, Index count) = 0;
    /// A square for one of every `stride`.
    virtual void draw_coarse(Index stride) = 0;
    /// Draws what lies over the elements; `whole`: all of these were drawn at full detail.
    virtual void end(Framebuffer& target, bool whole) = 0;
  };
  /// Null where there is nothing to draw. What it refers to must outlive it.
  [[nodiscard]] virtual std::unique_ptr<Pass> pass(const Camera& camera, const Style& style, Vec2<double> viewport,
                                                   const PicturePart& part) = 0;
  [[nodiscard]] virtual SceneView view_of(const Camera& camera, Vec2<double> viewport, const PicturePart& part) const = 0;
  /// Pixels beyond the borders of a part of a picture that must be drawn for it to fit its neighbours.
  [[nodiscard]] virtual int reach(const Style& /*style*/, Vec2<double> /*viewport*/) const { return 0; }

  /// A vertex as a corner of an element; kNoIndex: by itself.
  struct Corner {
    Index element, vertex;
  };
  /// Null where no places are known.
  [[nodiscard]] virtual const ElementTable* elements() const = 0;
  [[nodiscard]] virtual Index vertex_count() const = 0;
  /// Where corners are drawn, as points of the scene; those of an element stand together. Throws DeviceError.
  [[nodiscard]] virtual std::vector<Vec3> places_of(std::span<const Corner> corners) const = 0;

  /// Calls visit(element, polygon) for what is drawn of elements and not hidden: points of the scene. For none where there is too much of
  /// it.
  using VisitPolygon = std::function<void(Index, std::span<const Vec3>)>;
  virtual void visit_shown(const Camera& camera, Vec2<double> viewport, const VisitPolygon& visit) const = 0;

  /// Values that a shading must have; kNoIndex: there can be none such.
  [[nodiscard]] virtual Index value_count(Shading::By by) const = 0;
  [[nodiscard]] virtual Fill& fill() noexcept = 0;
  [[nodiscard]] MarkPainter& painter() noexcept { return *painter_; }
  [[nodiscard]] const Selection& selection() const noexcept { return selection_; }
  void changed() noexcept { ++revision_; }
  /// Another mesh: shading and selection were of the one before.
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
  std::optional<Framebuffer> wider_;  // than a part of a picture
  std::shared_ptr<const Shading> shading_;
  Selection selection_;
  std::uint64_t revision_ = 0;
};

}  // namespace dmoscope::render
