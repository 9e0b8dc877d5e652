#pragma once
// What elements are wished to be, as ellipses over those that are picked; in space the three of an ellipsoid.

#include <span>

#include "core/view/view.h"
#include "render/space_marks.h"
#include "render/style.h"

namespace dmoscope::ui {

/// For each element that has a target by `metric` an ellipse of the target's shape and direction, as large as the element, with its longer
/// axis; and, thinner, that of the element as it stands. Of planar meshes whose frame is on the host; others have none.
void add_targets(render::Marks& marks, const Frame& frame, Metric metric, std::span<const Index> elements);
/// The same of one element of a volume, around the axes of the ellipsoid.
void add_space_target(render::SpaceMarks& marks, const Frame& frame, Metric metric, Index element);

}  // namespace dmoscope::ui
