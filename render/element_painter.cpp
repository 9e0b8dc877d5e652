#include "render/element_painter.h"

#include <utility>

#include "core/run/summary.h"

namespace dmoscope::render {
namespace {

constexpr Stages kFill{"elements.vert.glsl", "elements.geom.glsl", "elements.frag.glsl"};

}  // namespace

void View::apply(const Program& program) const {
  program.use();
  program.set("u_offset_high", offset_high);
  program.set("u_offset_low", offset_low);
  program.set("u_zoom", zoom);
  program.set("u_viewport", viewport);
  program.set("u_widest", widest);
}

ElementPainter::ElementPainter()
    : fill_{{{Program(kFill), Program(kFill, {"QUADRILATERALS"})},
             {Program(kFill, {"BY_CORNERS"}), Program(kFill, {"BY_CORNERS", "QUADRILATERALS"})}}},
      coarse_({"coarse.vert.glsl", {}, "coarse.frag.glsl"}),
      boundary_({"lines.vert.glsl", {}, "lines.frag.glsl"}, {"BOUNDARY"}),
      nothing_(make_array()) {
  for (Elements& elements : elements_) elements.array = make_array();
}

void ElementPainter::upload_topology(const Layout& layout) {
  points_ = Buffer();
  shades_ = Buffer();
  edges_ = Buffer();
  colouring_.reset();
  odd_ = Odd::Unknown;
  points_.reserve(layout.vertex_count * sizeof(Vec2<float>));
  shades_.reserve(layout.element_count() * sizeof(float));
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    elements_[i].order = Buffer();
    elements_[i].corners = Buffer();
    elements_[i].order.write(std::span<const Index>(layout.batches[i].order));
    elements_[i].corners.write(std::span<const Index>(layout.corners_of(layout.batches[i])));
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
void ElementPainter::upload_points(Index first, std::span<const Vec2<float>> points) {
  points_.write_at(first * sizeof(Vec2<float>), std::as_bytes(points));
}
void ElementPainter::upload_shades(std::span<const float> shades) { shades_.write(shades); }

void ElementPainter::mark_inverted(const Layout& layout, std::span<const float> shades) {
  odd_ = shades.empty() ? Odd::Unknown : Odd::None;
  constexpr Index kTogether = 32;  // elements per bit
  const Index triangles = layout.batches[0].size();
  std::array<std::vector<std::uint32_t>, 2> bits;
  for (Index e = 0; e < shades.size(); ++e) {
    if (shades[e] != kInvertedShade) continue;
    if (std::exchange(odd_, Odd::Some) == Odd::None)
      for (std::size_t i = 0; i < bits.size(); ++i) bits[i].assign(layout.batches[i].size() / (kTogether * 32) + 1, 0);
    const Index slot = layout.slots[e], block = (slot < triangles ? slot : slot - triangles) / kTogether;
    bits[slot < triangles ? 0 : 1][block / 32] |= std::uint32_t{1} << (block % 32);
  }
  if (odd_ != Odd::Some) return;
  for (std::size_t i = 0; i < bits.size(); ++i) elements_[i].odd.write(std::span<const std::uint32_t>(bits[i]));
}

void ElementPainter::draw(const View& view, const Style& style, std::size_t batch, std::span<const DrawRange> ranges) {
  if (ranges.empty()) return;
  const Program& program = fill_[colouring_.by_vertices() ? 1 : 0][batch];
  const Elements& elements = elements_[batch];
  view.apply(program);
  colouring_.bind(program, style, shades_, elements_[batch].order);
  const float fade = 3.0F * style.scale;
  program.set("u_wire_fade", style.wireframe ? fade : 0.0F);
  program.set("u_hollow_fade", fade);
  program.set("u_wire_half_width", 0.5F * style.wire_width * style.scale);
  set_colour(program, "u_wire_colour", {style.wire_colour.r, style.wire_colour.g, style.wire_colour.b},
             static_cast<float>(style.wire_colour.a) / 255.0F);
  if (style.transparent) {
    program.set("u_hollow_fill", 0.0F, 0.0F, 0.0F, 0.0F);
  } else {
    set_colour(program, "u_hollow_fill", style.background);
  }
  set_colour(program, "u_hollow_colour", style.hollow_colour);
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

void ElementPainter::draw_coarse(const View& view, const Style& style, std::size_t batch, std::span<const DrawRange> ranges, Index stride) {
  if (ranges.empty()) return;
  view.apply(coarse_);
  colouring_.bind(coarse_, style, shades_, elements_[batch].order);
  points_.bind_storage(0);
  elements_[batch].corners.bind_storage(3);
  // With a selection, the shader asks of every element whether it counts.
  const Odd odd = colouring_.selects() ? Odd::Unknown : odd_;
  (odd == Odd::Some ? elements_[batch].odd : shades_).bind_storage(7);
  coarse_.set("u_look", odd == Odd::None ? 0 : odd == Odd::Some ? 1 : 2);
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
  boundary_.set("u_palette", 1);
  boundary_.set("u_edge_categories", colouring_.bind_edges(points_));
  boundary_.set("u_width", style.boundary_width * style.scale);
  set_colour(boundary_, "u_colour", {style.boundary_colour.r, style.boundary_colour.g, style.boundary_colour.b},
             static_cast<float>(style.boundary_colour.a) / 255.0F);
  DMOSCOPE_GL(glBindVertexArray(nothing_.id()));
  DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, edge_count_ * 6));
}

}  // namespace dmoscope::render
