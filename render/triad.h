#pragma once
// The axes of a mesh in space, drawn in the right lower corner of its picture.

#include <array>

#include "render/orbit_camera.h"

namespace dmoscope::render {

class MarkPainter;
struct Style;

/// Places of the letters of the axes in a viewport, in pixels from its upper left corner: x, y, z.
[[nodiscard]] std::array<Vec2<double>, 3> triad_letters(const OrbitCamera& camera, Vec2<double> viewport, double scale);

/// Hands the axes' directions to the painter, for `part` of a picture; those that point away from the eye behind those that point to it.
void gather_triad(const OrbitCamera& camera, Vec2<double> viewport, const PicturePart& part, const Style& style, MarkPainter& painter);

}  // namespace dmoscope::render
