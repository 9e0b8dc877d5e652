#pragma once
// Faces in the form that the shaders read. No OpenGL.

#include <array>
#include <span>
#include <vector>

#include "core/clipping/clipping.h"

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

}  // namespace dmoscope::render
