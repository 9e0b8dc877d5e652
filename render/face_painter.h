#pragma once
// Draws faces of volume elements on the OpenGL side. Only for sources of this module.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/clipping/clipping.h"
#include "render/fill.h"
#include "render/gl.h"
#include "render/orbit_camera.h"

namespace dmoscope::render {

/// A face, or a triangle or quadrilateral of a cut: see resources/shaders/faces.glsl.
struct FaceRecord {
  /// Indices into the positions. The last one of a triangle is kNoIndex less 1, 2 or 4 for the edges from its first, second, third corner
  /// that must not be seen.
  std::array<Index, 4> corners;
  Index element;
  friend bool operator==(const FaceRecord&, const FaceRecord&) = default;
};
static_assert(sizeof(FaceRecord) == 20);

/// Replaces `records` by those of the faces, in their order. `pool` may be null.
void records_of(const ElementTable& elements, std::span<const ElementFace> faces, std::vector<FaceRecord>& records,
                ThreadPool* pool = nullptr);

/// Replaces `records` by those of the polygons; a corner is the index of a point of the cuts. A polygon of more than four points shows its
/// own edges alone, not those of its triangles.
void records_of(const PlaneCuts& cuts, std::vector<FaceRecord>& records);

/// A camera in the form that the shaders of faces take. Positions are relative to an origin.
struct SpaceView {
  SpaceView(const OrbitCamera& camera, const Projection& projection);
  std::array<float, 16> to_clip_space{};
  std::array<float, 4> eye{}, light{};
  Vec2<float> viewport;
  Vec2<float> hatch_phase;
};

class FacePainter {
 public:
  FacePainter();
  /// Prepares for another mesh: the buffers' content is lost.
  void reset();
  using Point = std::array<float, 3>;
  void upload_points(std::span<const Point> points) { points_.write(points); }
  void upload_shades(std::span<const float> shades) { shades_.write(shades); }
  /// Replaces the mean of each element's corners; needed while elements are drawn shrunk.
  void upload_means(std::span<const Point> means) { means_.write(means); }
  void upload_faces(std::span<const FaceRecord> faces) { upload(faces_, faces); }
  void upload_ghost(std::span<const FaceRecord> faces) { upload(ghost_, faces); }
  void upload_cuts(std::span<const FaceRecord> faces, std::span<const Point> points);
  [[nodiscard]] Fill& fill() noexcept { return colouring_; }

  /// Look of faces.
  struct Look {
    const Style& style;
    double shrink = 1.0;
    bool both_sides = false;                    // both sides of a surface are seen; false for a closed skin
    std::optional<std::array<float, 4>> plane;  // normal and offset of a plane; everything beyond it is left out
  };
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(faces_.count); }
  void draw_faces(const SpaceView& view, const Look& look, Index first, Index count) const;
  /// Draws a square for one of every `stride` faces.
  void draw_coarse(const SpaceView& view, const Look& look, Index stride) const;
  void draw_cuts(const SpaceView& view, const Style& style) const;
  /// Draws faces that the others are seen through; to be called before the others are drawn.
  void draw_ghost(const SpaceView& view, const Style& style) const;

 private:
  struct Faces {
    Buffer records;
    GLsizei count = 0;
  };
  static void upload(Faces& to, std::span<const FaceRecord> faces) {
    to.records.write(faces);
    to.count = static_cast<GLsizei>(faces.size());
  }
  void prepare(const Program& program, const Faces& faces, const Buffer& points, const SpaceView& view, const Look& look) const;
  Program program_, ghost_program_, coarse_program_;
  Fill colouring_;
  Buffer points_, shades_, means_, cut_points_;
  Faces faces_, ghost_, cuts_;
  Handle<DeleteVertexArray> nothing_;
};

}  // namespace dmoscope::render
