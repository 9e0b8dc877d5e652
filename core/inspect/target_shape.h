#pragma once
// Target of an element for pictures: an ellipse beside that of the element.

#include <optional>

#include "core/input/input_mesh.h"
#include "core/mesh/position_view.h"
#include "core/numeric/small_matrix.h"

namespace dmoscope {

/// Maps from the ideal element, whose edges have length 1, into the frame that the element is judged in, at a corner or in the mean over
/// the corners. The image of a circle (a sphere) shows size, stretch and direction.
struct TargetShapeOfElement {
  SmallMatrix now;     // map from the ideal element to the present one
  SmallMatrix wished;  // map from the ideal element to its target; a target that may be rotated is rotated like the element
  /// Ratio of the longest to the shortest axis.
  [[nodiscard]] static double aspect(const SmallMatrix& map);
};

/// The maps of an element. None if the metric has no target there, or the element is flat or inverted. Throws as QualityContext::judge
/// does.
[[nodiscard]] std::optional<TargetShapeOfElement> target_shape(const InputMesh& input, PositionView positions, Metric metric,
                                                               Index element);

}  // namespace dmoscope
