#pragma once
// Quality of a mesh's elements by a metric that is defined by a formula or a target.

#include <span>

#include "core/mesh/position_view.h"
#include "core/quality/defined_judge.h"
#include "core/quality/quality.h"

namespace dmoscope {

/// The origin to which the corners of an element of a planar mesh are relative, in its plane; (0, 0, 0) for any other mesh.
[[nodiscard]] inline Vec3 origin_of_corners(const Geometry& geometry, Vec3 first_corner) {
  if (geometry.shape != Shape::Planar) return {};
  const Vec2<double> p = geometry.plane.project(first_corner);
  return {p.x, p.y, 0.0};
}

/// The metric of one element with its vertices where at(vertex) says. `moving`: see DefinedJudge::quality.
template <class At>
[[nodiscard]] double defined_quality_at(const DefinedJudge& judge, const ElementFrames& frames, ElementKind kind,
                                        std::span<const Index> corners, Index element, const At& at, Index moving = kNoIndex) {
  DefinedJudge::Corners places{};
  frames.gather(corners, element, info(kind).dimension, at, places);
  return judge.quality(element, kind, places, origin_of_corners(frames.geometry, at(corners[0])), moving);
}

/// The metric of one element; the same bits as element_quality().
[[nodiscard]] double defined_quality(const QualityContext& context, const DefinedJudge& judge, PositionView positions, Index element);
/// The metric of the elements [first, first + count), into out.
void defined_qualities(const QualityContext& context, const DefinedJudge& judge, std::span<const Vec3> positions, Index first,
                       std::size_t count, double* out);

}  // namespace dmoscope
