#include "render/face_painter.h"

#include <algorithm>

#include "render/element_painter.h"

namespace dmoscope::render {
namespace {

constexpr Stages kFaces{"faces.vert.glsl", {}, "faces.frag.glsl"};
constexpr Index kMostAtOnce = 1U << 24U;  // faces: six vertices of each must be counted in 31 bits

std::array<float, 4> four(Vec3 v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

void set_four(const Program& program, const char* name, const std::array<float, 4>& v) { program.set(name, v[0], v[1], v[2], v[3]); }

void set_wire(const Program& program, const Style& style) {
  set_colour(program, "u_wire_colour", {style.wire_colour.r, style.wire_colour.g, style.wire_colour.b},
             static_cast<float>(style.wire_colour.a) / 255.0F);
}

}  // namespace

SpaceView::SpaceView(const OrbitCamera& camera, const Projection& projection) {
  std::ranges::transform(projection.matrix(), to_clip_space.begin(), [](double x) { return static_cast<float>(x); });
  const Vec3 back = camera.back();
  eye = camera.perspective ? four(camera.eye() - projection.origin(), 1.0) : four(back, 0.0);
  // Light comes from over the left shoulder, so that faces at the same angle to the line of sight differ.
  const Vec3 towards = back + 0.45 * camera.up + -0.3 * camera.right;
  light = four(1.0 / length(towards) * towards, 0.0);
  viewport = {static_cast<float>(projection.viewport().x), static_cast<float>(projection.viewport().y)};
}

FacePainter::FacePainter()
    : program_(kFaces),
      ghost_program_(kFaces, {"GHOST"}),
      coarse_program_({"faces_coarse.vert.glsl", {}, "coarse.frag.glsl"}),
      nothing_(make_array()) {
  reset();
}

void FacePainter::reset() {
  colouring_.reset();
  for (Buffer* buffer : {&points_, &shades_, &means_, &cut_points_, &faces_.records, &ghost_.records, &cuts_.records}) {
    *buffer = Buffer();
    buffer->reserve(sizeof(Point));  // at least one, so that there is a buffer to bind
  }
  faces_.count = ghost_.count = cuts_.count = 0;
}

void FacePainter::upload_cuts(std::span<const FaceRecord> faces, std::span<const Point> points) {
  cut_points_.write(points);
  upload(cuts_, faces);
}

/// Binds and sets everything that the shaders of faces read.
void FacePainter::prepare(const Program& program, const Faces& faces, const Buffer& points, const SpaceView& view, const Look& look) const {
  program.use();
  program.set("u_viewport", view.viewport);
  program.set("u_to_clip_space", view.to_clip_space);
  set_four(program, "u_eye", view.eye);
  set_four(program, "u_light", view.light);
  program.set("u_shading", look.style.shading ? 1.0F : 0.0F);
  set_four(program, "u_plane", look.plane.value_or(std::array{0.0F, 0.0F, 0.0F, 1.0F}));
  program.set("u_shrink", static_cast<float>(look.shrink));
  program.set("u_sides", look.both_sides ? 2 : 1);
  program.set("u_hatch_period", kHatchPeriod * look.style.scale);
  program.set("u_hatch_phase", view.hatch_phase);
  program.set("u_wire_fade", look.style.wireframe ? 3.0F * look.style.scale : 0.0F);
  program.set("u_wire_half_width", 0.5F * look.style.wire_width * look.style.scale);
  colouring_.bind(program, look.style, shades_, shades_);
  points.bind_storage(0);
  faces.records.bind_storage(3);
  means_.bind_storage(4);
  DMOSCOPE_GL(glBindVertexArray(nothing_.id()));
}

void FacePainter::draw_faces(const SpaceView& view, const Look& look, Index first, Index count) const {
  if (count == 0) return;
  prepare(program_, faces_, points_, view, look);
  set_wire(program_, look.style);
  if (look.plane) glEnable(GL_CLIP_DISTANCE0);
  while (count > 0) {
    const Index now = std::min(kMostAtOnce, count);
    program_.set("u_first", first);
    DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * now)));
    first += now;
    count -= now;
  }
  program_.set("u_first", 0U);
  glDisable(GL_CLIP_DISTANCE0);
}

void FacePainter::draw_coarse(const SpaceView& view, const Look& look, Index stride) const {
  if (faces_.count == 0) return;
  prepare(coarse_program_, faces_, points_, view, look);
  coarse_program_.set("u_stride", stride);
  coarse_program_.set("u_count", face_count());
  if (look.plane) glEnable(GL_CLIP_DISTANCE0);
  glEnable(GL_PROGRAM_POINT_SIZE);
  DMOSCOPE_GL(glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>((face_count() + stride - 1) / stride)));
  glDisable(GL_PROGRAM_POINT_SIZE);
  glDisable(GL_CLIP_DISTANCE0);
}

void FacePainter::draw_cuts(const SpaceView& view, const Style& style) const {
  if (cuts_.count == 0) return;
  prepare(program_, cuts_, cut_points_, view, {.style = style, .shrink = 1.0, .both_sides = false, .plane = {}});
  set_wire(program_, style);
  program_.set("u_cut", 1.0F);
  DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, 6 * cuts_.count));
  program_.set("u_cut", 0.0F);
}

void FacePainter::draw_ghost(const SpaceView& view, const Style& style) const {
  if (ghost_.count == 0) return;
  constexpr float kFace = 0.04F, kEdge = 0.16F;  // alpha
  prepare(ghost_program_, ghost_, points_, view, {.style = style, .shrink = 1.0, .both_sides = false, .plane = {}});
  const Rgb colour{style.boundary_colour.r, style.boundary_colour.g, style.boundary_colour.b};
  set_colour(ghost_program_, "u_ghost_colour", colour, kFace);
  set_colour(ghost_program_, "u_wire_colour", colour, kEdge);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_DEPTH_TEST);
  DMOSCOPE_GL(glDrawArrays(GL_TRIANGLES, 0, 6 * ghost_.count));
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
}

void records_of(const ElementTable& elements, std::span<const ElementFace> faces, std::vector<FaceRecord>& records, ThreadPool* pool) {
  records.resize(faces.size());
  for_chunks(pool, faces.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) records[i] = {vertices_of(elements, faces[i]), faces[i].element};
  });
}

void records_of(const PlaneCuts& cuts, std::vector<FaceRecord>& records) {
  records.clear();
  for (const CutPolygon& polygon : cuts.polygons) {
    const Index p = polygon.first;
    if (polygon.count == 4) {
      records.push_back({{p, p + 1, p + 2, p + 3}, polygon.element});
      continue;
    }
    for (Index i = 1; i + 1 < polygon.count; ++i) {
      const Index inner = (i > 1 ? 1U : 0U) + (i + 2 < polygon.count ? 4U : 0U);
      records.push_back({{p, p + i, p + i + 1, kNoIndex - inner}, polygon.element});
    }
  }
}

}  // namespace dmoscope::render
