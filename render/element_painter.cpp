#include "render/element_painter.h"

#include <cmath>

namespace dmoscope::render {
namespace {

constexpr int kColours = 4096;
constexpr Stages kFill{"elements.vert.glsl", "elements.geom.glsl", "elements.frag.glsl"};

Handle<DeleteVertexArray> make_array() {
  GLuint id = 0;
  DMOSCOPE_GL(glCreateVertexArrays(1, &id));
  return Handle<DeleteVertexArray>(id);
}

void set_colour(const Program& program, const char* name, Rgb colour, float alpha = 1.0F) {
  program.set(name, static_cast<float>(colour.r) / 255.0F, static_cast<float>(colour.g) / 255.0F, static_cast<float>(colour.b) / 255.0F,
              alpha);
}

bool same(const ColourScale& a, const ColourScale& b) {
  return a.map == b.map && a.reversed == b.reversed && a.steps == b.steps && a.low == b.low && a.high == b.high;
}

}  // namespace

void View::apply(const Program& program) const {
  program.use();
  program.set("u_offset_high", offset_high);
  program.set("u_offset_low", offset_low);
  program.set("u_zoom", zoom);
  program.set("u_viewport", viewport);
}

ElementPainter::ElementPainter()
    : fill_{Program(kFill), Program(kFill, "QUADRILATERALS")},
      coarse_({"coarse.vert.glsl", {}, "coarse.frag.glsl"}),
      boundary_({"lines.vert.glsl", {}, "lines.frag.glsl"}, "BOUNDARY"),
      nothing_(make_array()) {
  GLuint id = 0;
  DMOSCOPE_GL(glCreateTextures(GL_TEXTURE_2D, 1, &id));
  colours_ = Handle<DeleteTexture>(id);
  DMOSCOPE_GL(glTextureStorage2D(id, 1, GL_RGBA8, kColours, 1));
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  for (Elements& elements : elements_) elements.array = make_array();
  for (const Program& program : fill_) {
    set_colour(program, "u_inverted_colour", kInvertedColour);
    set_colour(program, "u_undefined_colour", kUndefinedColour);
  }
  set_colour(coarse_, "u_inverted_colour", kInvertedColour);
  set_colour(coarse_, "u_undefined_colour", kUndefinedColour);
}

void ElementPainter::upload_topology(const Layout& layout) {
  points_ = Buffer();
  shades_ = Buffer();
  edges_ = Buffer();
  points_.reserve(layout.vertex_count * sizeof(Vec2<float>));
  shades_.reserve(layout.element_count() * sizeof(float));
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    elements_[i].order = Buffer();
    elements_[i].corners = Buffer();
    elements_[i].order.write(std::span<const Index>(layout.batches[i].order));
    elements_[i].corners.write(std::span<const Index>(layout.batches[i].corners));
  }
  edges_.write(std::span<const std::array<Index, 2>>(layout.boundary_edges));
  edge_count_ = static_cast<GLsizei>(layout.boundary_edges.size());
  for (Elements& elements : elements_) {
    const GLuint array = elements.array.id();
    DMOSCOPE_GL(glVertexArrayVertexBuffer(array, 0, points_.id(), 0, sizeof(Vec2<float>)));
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribFormat(array, 0, 2, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    DMOSCOPE_GL(glVertexArrayElementBuffer(array, elements.corners.id()));
  }
}

void ElementPainter::upload_points(std::span<const Vec2<float>> points) { points_.write(points); }
void ElementPainter::upload_shades(std::span<const float> shades) { shades_.write(shades); }

void ElementPainter::set_colours(const ColourScale& colours) {
  if (uploaded_ && same(*uploaded_, colours)) return;
  std::vector<std::uint8_t> table;
  table.reserve(std::size_t{4} * kColours);
  for (int i = 0; i < kColours; ++i) {
    ColourScale unit = colours;
    unit.low = 0.0;
    unit.high = 1.0;
    const Rgb colour = unit.colour(static_cast<double>(i) / (kColours - 1));
    table.insert(table.end(), {colour.r, colour.g, colour.b, std::uint8_t{255}});
  }
  GLint alignment = 4;
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  DMOSCOPE_GL(glTextureSubImage2D(colours_.id(), 0, 0, 0, kColours, 1, GL_RGBA, GL_UNSIGNED_BYTE, table.data()));
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
  // The end of the range must differ from its begin for the shaders' division.
  const float low = static_cast<float>(colours.low);
  float high = static_cast<float>(colours.high);
  if (!(high > low)) high = std::nextafter(low, 3e38F);
  for (const Program* program : {&fill_[0], &fill_[1], &coarse_}) program->set("u_range", Vec2<float>{low, high});
  uploaded_ = colours;
}

void ElementPainter::bind_colours(const Program& program) const {
  DMOSCOPE_GL(glBindTextureUnit(0, colours_.id()));
  program.set("u_colours", 0);
}

void ElementPainter::draw(const View& view, const Style& style, std::size_t batch, std::span<const DrawRange> ranges) {
  if (ranges.empty()) return;
  const Program& program = fill_[batch];
  const Elements& elements = elements_[batch];
  view.apply(program);
  bind_colours(program);
  shades_.bind_storage(1);
  elements.order.bind_storage(2);
  program.set("u_wire_fade", style.wireframe ? 3.0F * style.scale : 0.0F);
  program.set("u_wire_half_width", 0.5F * style.wire_width * style.scale);
  set_colour(program, "u_wire_colour", {style.wire_colour.r, style.wire_colour.g, style.wire_colour.b},
             static_cast<float>(style.wire_colour.a) / 255.0F);
  program.set("u_hatch_period", kHatchPeriod * style.scale);
  program.set("u_hatch_phase", view.hatch_phase);
  DMOSCOPE_GL(glBindVertexArray(elements.array.id()));
  const std::size_t corner_count = batch == 0 ? 3 : 4;
  for (const DrawRange& range : ranges) {
    program.set("u_first", range.first);
    const auto count = static_cast<GLsizei>((range.last - range.first) * corner_count);
    const auto* offset = reinterpret_cast<const void*>(range.first * corner_count * sizeof(Index));
    DMOSCOPE_GL(glDrawElements(batch == 0 ? GL_TRIANGLES : GL_LINES_ADJACENCY, count, GL_UNSIGNED_INT, offset));
  }
}

void ElementPainter::draw_coarse(const View& view, std::size_t batch, std::span<const DrawRange> ranges, Index stride) {
  if (ranges.empty()) return;
  const Elements& elements = elements_[batch];
  view.apply(coarse_);
  bind_colours(coarse_);
  points_.bind_storage(0);
  shades_.bind_storage(1);
  elements.order.bind_storage(2);
  elements.corners.bind_storage(3);
  coarse_.set("u_stride", stride);
  coarse_.set("u_corner_count", batch == 0 ? 3U : 4U);
  DMOSCOPE_GL(glBindVertexArray(nothing_.id()));
  glEnable(GL_PROGRAM_POINT_SIZE);
  for (const DrawRange& range : ranges) {
    // Always the same elements, whatever part of the mesh is in view.
    const Index first = (range.first + stride - 1) / stride * stride;
    if (first >= range.last) continue;
    coarse_.set("u_first", first);
    coarse_.set("u_last", range.last);
    DMOSCOPE_GL(glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>((range.last - first + stride - 1) / stride)));
  }
  glDisable(GL_PROGRAM_POINT_SIZE);
}

void ElementPainter::draw_boundary(const View& view, const Style& style) {
  if (edge_count_ == 0) return;
  view.apply(boundary_);
  points_.bind_storage(0);
  edges_.bind_storage(4);
  boundary_.set("u_width", style.boundary_width * style.scale);
  set_colour(boundary_, "u_colour", {style.boundary_colour.r, style.boundary_colour.g, style.boundary_colour.b},
             static_cast<float>(style.boundary_colour.a) / 255.0F);
  DMOSCOPE_GL(glBindVertexArray(nothing_.id()));
  DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, edge_count_ * 6));
}

}  // namespace dmoscope::render
