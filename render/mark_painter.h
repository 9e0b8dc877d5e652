#pragma once
// Draws lines and dots given in pixels on the OpenGL side. Only for sources of this module.

#include <vector>

#include "render/element_painter.h"
#include "render/gl.h"
#include "render/marks.h"
#include "render/style.h"

namespace dmoscope::render {

/// Gathers lines and dots, then draws them: lines first. Pixels are relative to the middle of the viewport, y up.
class MarkPainter {
 public:
  MarkPainter();
  void line(Vec2<double> from, Vec2<double> to, float width, Rgba colour);
  void dot(Vec2<double> middle, float diameter, DotShape shape, Rgba fill, Rgba casing);
  /// Draws what was gathered, and forgets it. `scale`: Style::scale.
  void flush(const View& view, float scale);

 private:
  struct Line {
    float ends[4], colour[4], width[4];
  };
  struct Dot {
    float place[4], fill[4], casing[4];
  };
  Program line_program_, dot_program_;
  Handle<DeleteVertexArray> nothing_;
  Buffer line_buffer_, dot_buffer_;
  std::vector<Line> lines_;
  std::vector<Dot> dots_;
};

}  // namespace dmoscope::render
