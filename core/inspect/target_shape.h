#pragma once
// What an element is wished to be, as a picture shows it: an ellipse beside that of the element.

#include <optional>

#include "core/input/input_mesh.h"
#include "core/mesh/position_view.h"
#include "core/numeric/small_matrix.h"

namespace dmoscope {

/// Maps of the ideal element, whose edges have the length 1, in the frame that the element is judged in: of a corner, or the mean over the
/// corners. The image of a circle (a sphere) shows size, stretch and direction.
struct TargetShapeOfElement {
  SmallMatrix now;     // the ideal element to the element as it stands
  SmallMatrix wished;  // ... to its target; of a target that may be turned, turned as the element is
  /// Longest over shortest axis.
  [[nodiscard]] static double aspect(const SmallMatrix& map);
};

/// None where the metric has no target there, or the element is flat or inverted. Throws as QualityContext::judge does.
[[nodiscard]] std::optional<TargetShapeOfElement> target_shape(const InputMesh& input, PositionView positions, Metric metric,
                                                               Index element);

}  // namespace dmoscope
