#include "render/element_painter.h"

#include <algorithm>
#include <cmath>

#include "core/session/summary.h"

namespace dmoscope::render {
namespace {

constexpr int kColours = 4096, kMostCategories = 256;
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

Handle<DeleteTexture> make_table(int colours) {
  GLuint id = 0;
  DMOSCOPE_GL(glCreateTextures(GL_TEXTURE_2D, 1, &id));
  Handle<DeleteTexture> table(id);
  DMOSCOPE_GL(glTextureStorage2D(id, 1, GL_RGBA8, colours, 1));
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return table;
}

void fill_table(const Handle<DeleteTexture>& table, std::span<const Rgb> colours) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * colours.size());
  for (const Rgb colour : colours) bytes.insert(bytes.end(), {colour.r, colour.g, colour.b, std::uint8_t{255}});
  GLint alignment = 4;
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const auto width = static_cast<GLsizei>(colours.size());
  DMOSCOPE_GL(glTextureSubImage2D(table.id(), 0, 0, 0, width, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data()));
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
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
    : fill_{{{Program(kFill), Program(kFill, {"QUADRILATERALS"})},
             {Program(kFill, {"BY_CORNERS"}), Program(kFill, {"BY_CORNERS", "QUADRILATERALS"})}}},
      coarse_({"coarse.vert.glsl", {}, "coarse.frag.glsl"}),
      boundary_({"lines.vert.glsl", {}, "lines.frag.glsl"}, {"BOUNDARY"}),
      colours_(make_table(kColours)),
      palette_(make_table(kMostCategories)),
      nothing_(make_array()) {
  for (Elements& elements : elements_) elements.array = make_array();
}

void ElementPainter::upload_topology(const Layout& layout) {
  points_ = Buffer();
  shades_ = Buffer();
  edges_ = Buffer();
  values_ = Buffer();
  members_ = Buffer();
  by_.reset();
  categories_ = 0;
  edges_by_category_ = false;
  selection_ = {};
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
  ColourScale unit = colours;
  unit.low = 0.0;
  unit.high = 1.0;
  if (uploaded_ == unit) return;
  std::vector<Rgb> table(kColours);
  for (std::size_t i = 0; i < kColours; ++i) table[i] = unit.colour(static_cast<double>(i) / (kColours - 1));
  fill_table(colours_, table);
  uploaded_ = unit;
}

void ElementPainter::set_shading(const Shading* shading) {
  by_.reset();
  categories_ = 0;
  edges_by_category_ = false;
  if (shading == nullptr) return;
  by_ = shading->by;
  categories_ = static_cast<int>(std::min<std::size_t>(shading->palette.size(), kMostCategories));
  edges_by_category_ = shading->edges && categories_ > 0 && by_ == Shading::By::Vertices;
  if (categories_ > 0) fill_table(palette_, std::span(shading->palette).first(static_cast<std::size_t>(categories_)));
  std::vector<float> values = shading->values;
  for (float& value : values) value = shade_of(value, false);
  values_.write(std::span<const float>(values));
}

void ElementPainter::set_selection(const Selection& selection) {
  if (selection.members && selection.members != selection_.members) {
    const std::vector<std::uint8_t>& members = *selection.members;
    std::vector<std::uint32_t> bits((members.size() + 31) / 32, 0);
    for (std::size_t e = 0; e < members.size(); ++e) bits[e / 32] |= static_cast<std::uint32_t>(members[e] != 0 ? 1 : 0) << (e % 32);
    members_.write(std::span<const std::uint32_t>(bits));
  }
  selection_ = selection;
}

void ElementPainter::bind_fill(const Program& program, const Style& style, std::size_t batch) const {
  DMOSCOPE_GL(glBindTextureUnit(0, colours_.id()));
  DMOSCOPE_GL(glBindTextureUnit(1, palette_.id()));
  shades_.bind_storage(1);
  elements_[batch].order.bind_storage(2);
  (by_ ? values_ : shades_).bind_storage(5);
  (selection_.members ? members_ : shades_).bind_storage(6);
  program.set("u_colours", 0);
  program.set("u_palette", 1);
  program.set("u_by", !by_ ? 0 : *by_ == Shading::By::Elements ? 1 : 2);
  program.set("u_categories", categories_);
  // The end of the range must differ from its begin for the shaders' division.
  const auto low = static_cast<float>(style.colours.low);
  auto high = static_cast<float>(style.colours.high);
  if (!(high > low)) high = std::nextafter(low, 3e38F);
  program.set("u_range", Vec2<float>{low, high});
  set_colour(program, "u_inverted_colour", kInvertedColour);
  set_colour(program, "u_undefined_colour", kUndefinedColour);
  set_colour(program, "u_neutral_colour", style.neutral_colour);
  constexpr float kFadedWire = 0.3F;
  set_colour(program, "u_faded_colour", style.faded_colour, kFadedWire);
  const auto range = selection_.quality.value_or(std::pair{0.0F, 0.0F});
  program.set("u_filter", range.first, range.second, selection_.quality ? 1.0F : 0.0F,
              in_quality_range(range, kInvertedShade) ? 1.0F : 0.0F);
  program.set("u_has_members", selection_.members ? 1 : 0);
  program.set("u_others", static_cast<int>(selection_.others));
}

void ElementPainter::draw(const View& view, const Style& style, std::size_t batch, std::span<const DrawRange> ranges) {
  if (ranges.empty()) return;
  const Program& program = fill_[by_ == Shading::By::Vertices ? 1 : 0][batch];
  const Elements& elements = elements_[batch];
  view.apply(program);
  bind_fill(program, style, batch);
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
  bind_fill(coarse_, style, batch);
  points_.bind_storage(0);
  elements_[batch].corners.bind_storage(3);
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
  (edges_by_category_ ? values_ : points_).bind_storage(5);
  DMOSCOPE_GL(glBindTextureUnit(1, palette_.id()));
  boundary_.set("u_palette", 1);
  boundary_.set("u_edge_categories", edges_by_category_ ? categories_ : 0);
  boundary_.set("u_width", style.boundary_width * style.scale);
  set_colour(boundary_, "u_colour", {style.boundary_colour.r, style.boundary_colour.g, style.boundary_colour.b},
             static_cast<float>(style.boundary_colour.a) / 255.0F);
  DMOSCOPE_GL(glBindVertexArray(nothing_.id()));
  DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, edge_count_ * 6));
}

}  // namespace dmoscope::render
