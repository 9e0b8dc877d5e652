#pragma once
// What elements are wished to be, as ellipses over those that are picked.

#include <span>

#include "core/view/view.h"
#include "render/style.h"

namespace dmoscope::ui {

/// For each element that has a target by `metric` an ellipse of the target's shape and direction, as large as the element, with its longer
/// axis; and, thinner, that of the element as it stands. Of planar meshes whose frame is on the host; others have none.
void add_targets(render::Marks& marks, const Frame& frame, Metric metric, std::span<const Index> elements);

}  // namespace dmoscope::ui
