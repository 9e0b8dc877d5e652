#pragma once
// What every mesh on the OpenGL side offers, planar or volume: it is shown, coloured, drawn in one go or bit by bit, and picked from.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/mesh.h"
#include "core/view/view.h"
#include "render/camera.h"
#include "render/framebuffer.h"
#include "render/orbit_camera.h"
#include "render/shading.h"
#include "render/space_marks.h"
#include "render/style.h"

namespace dmoscope::render {

/// Camera2D: of a planar mesh; OrbitCamera: of a volume.
using Camera = std::variant<Camera2D, OrbitCamera>;
/// Likewise.
using SceneMarks = std::variant<Marks, SpaceMarks>;

/// What lies under a pixel.
struct Pick {
  Index element = kNoIndex;      // the one drawn on top there; inverted elements lie above the others
  Index vertex = kNoIndex;       // the nearest within the radius
  double vertex_distance = 0.0;  // pixels; meaningful when there is a vertex
};

/// Which ids are to be written, where there is space for them.
struct Label {
  Vec2<double> point;  // of the plane, where the middle of the text belongs
  Index id = kNoIndex;
  bool vertex = false;  // else an element
};
struct LabelWish {
  bool vertices = false, elements = false;
  double digit_width = 8.0, line_height = 15.0;  // of the text, pixels
  std::size_t most = 400;                        // where there would be more, none are shown
};

/// How far a picture that is drawn in slices has come.
struct SliceProgress {
  bool begun = false;
  Index drawn = 0;  // elements in view that are done
};

/// Whether to wait until a big mesh is made ready for drawing.
enum class Loading { Wait, Background };

/// A mesh that is drawn. Functions that take a camera or marks throw std::bad_variant_access for those of the other kind of mesh.
class Scene {
 public:
  virtual ~Scene() = default;

  /// Shows a frame: topology when frame->input_serial differs from the last one's, positions and qualities in place when frame->serial
  /// does; otherwise costs nothing. Null shows nothing. Returns whether `frame` is on show now.
  virtual bool show(std::shared_ptr<const Frame> frame, Loading loading = Loading::Wait) = 0;
  /// What is shown instead of quality; null: quality. Forgotten when another mesh is shown. Throws UsageError for other than one value per
  /// element or vertex.
  virtual void set_shading(std::shared_ptr<const Shading> shading) = 0;
  /// Which elements count; forgotten when another mesh is shown. Throws UsageError when the members are not as many as the elements.
  virtual void set_selection(const Selection& selection) = 0;

  /// Grows with every change of what is drawn, camera, style and marks apart.
  [[nodiscard]] virtual std::uint64_t revision() const noexcept = 0;
  [[nodiscard]] virtual bool empty() const noexcept = 0;
  /// Elements, or faces, there are to draw.
  [[nodiscard]] virtual std::size_t drawn_count() const noexcept = 0;
  /// Share of `count` of them worth drawing, (0, 1]: 1 except on software OpenGL while something moves (a drag, a run that is drawn live),
  /// where it is what keeps a frame below about 100 ms.
  [[nodiscard]] double suggested_detail(std::size_t count, bool is_software, bool moving) const noexcept {
    return is_software && moving && count > 0 ? std::min(1.0, affordable_ / static_cast<double>(count)) : 1.0;
  }

  /// Clears `target` and draws all but the marks. detail in (0, 1]: below 1 a coarser picture of that share. Returns whether all in view
  /// was drawn. Throws Error.
  virtual bool draw_elements(Framebuffer& target, const Camera& camera, const Style& style, double detail = 1.0) = 0;
  /// Draws marks over it.
  virtual void draw_marks(Framebuffer& target, const Camera& camera, const Style& style, const SceneMarks& marks) = 0;
  /// draw_elements at full detail, bit by bit: at most `most` elements more, and waits until they are drawn. Camera, style and revision()
  /// must be those of the slices before. Returns whether it was the last slice. Throws Error.
  virtual bool draw_slice(Framebuffer& target, const Camera& camera, const Style& style, SliceProgress& progress, Index most) = 0;
  /// Draws all at full detail: the picture is `viewport` pixels large, and the target gets that part of it. Throws Error.
  virtual void draw_part(Framebuffer& target, const Camera& camera, const Style& style, const SceneMarks& marks, Vec2<double> viewport,
                         const PicturePart& part) = 0;

  /// What is at `pixel` (of a viewport of that size) by geometry in double, not by colours. `radius`: how far a vertex may be, in pixels.
  [[nodiscard]] virtual Pick pick(const Camera& camera, Vec2<double> viewport, Vec2<double> pixel, double radius = 8.0) const = 0;
  /// The ids that have space in a viewport of that size. None when there are more than wish.most, or too much is in view to look at it all.
  [[nodiscard]] virtual std::vector<Label> labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish) const = 0;

 protected:
  /// `affordable`: elements or faces that llvmpipe on two cores draws, coarsely, well within 100 ms.
  explicit Scene(double affordable) : affordable_(affordable) {}
  Scene(Scene&&) noexcept = default;
  Scene& operator=(Scene&&) noexcept = default;

 private:
  double affordable_;
};

}  // namespace dmoscope::render
