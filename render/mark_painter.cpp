#include "render/mark_painter.h"

#include <algorithm>

namespace dmoscope::render {
namespace {

void put(float (&to)[4], Rgba colour) {
  to[0] = static_cast<float>(colour.r) / 255.0F;
  to[1] = static_cast<float>(colour.g) / 255.0F;
  to[2] = static_cast<float>(colour.b) / 255.0F;
  to[3] = static_cast<float>(colour.a) / 255.0F;
}

/// Clamps a pixel's coordinate: far outside the picture only the direction matters, and floats would run out of digits.
float pixel(double value) { return static_cast<float>(std::clamp(value, -1e6, 1e6)); }

}  // namespace

MarkPainter::MarkPainter()
    : line_program_({"lines.vert.glsl", {}, "lines.frag.glsl"}), dot_program_({"dots.vert.glsl", {}, "dots.frag.glsl"}) {
  GLuint id = 0;
  DMOSCOPE_GL(glCreateVertexArrays(1, &id));
  nothing_ = Handle<DeleteVertexArray>(id);
}

void MarkPainter::line(Vec2<double> from, Vec2<double> to, float width, Rgba colour) {
  Line& line = lines_.emplace_back(Line{{pixel(from.x), pixel(from.y), pixel(to.x), pixel(to.y)}, {}, {width, 0, 0, 0}});
  put(line.colour, colour);
}

void MarkPainter::dot(Vec2<double> middle, float diameter, DotShape shape, Rgba fill, Rgba casing) {
  Dot& dot = dots_.emplace_back(Dot{{pixel(middle.x), pixel(middle.y), diameter, static_cast<float>(shape)}, {}, {}});
  put(dot.fill, fill);
  put(dot.casing, casing);
}

void MarkPainter::flush(const View& view, float scale) {
  DMOSCOPE_GL(glBindVertexArray(nothing_.id()));
  if (!lines_.empty()) {
    line_buffer_.write(std::span<const Line>(lines_));
    line_buffer_.bind_storage(4);
    view.apply(line_program_);
    DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(lines_.size() * 6)));
  }
  if (!dots_.empty()) {
    dot_buffer_.write(std::span<const Dot>(dots_));
    dot_buffer_.bind_storage(4);
    view.apply(dot_program_);
    dot_program_.set("u_casing_width", 1.2F * scale);
    dot_program_.set("u_ring_width", 2.2F * scale);
    DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(dots_.size() * 6)));
  }
  lines_.clear();
  dots_.clear();
}

}  // namespace dmoscope::render
