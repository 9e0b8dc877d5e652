#pragma once
// What is marked over the picture of a volume mesh. Only for sources of this module.

#include "render/mark_painter.h"
#include "render/volume_pick.h"
#include "render/volume_scene.h"

namespace dmoscope::render {

/// Hands lines and dots to the painter.
void gather_marks(const SeenFaces& seen, const Projection& projection, const Style& style, const SpaceMarks& marks, MarkPainter& painter);

/// The axes' directions, `middle` in pixels from the middle of the viewport, y up; those that point away behind those that point here.
void gather_triad(const OrbitCamera& camera, Vec2<double> middle, const Style& style, MarkPainter& painter);
/// Pixels at scale 1 from the right lower corner of the picture to the triad's middle.
inline constexpr double kTriadMargin = 58.0;

}  // namespace dmoscope::render
