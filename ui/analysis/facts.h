#pragma once
// Facts about the picked vertex or element of a frame.

#include <optional>
#include <string>
#include <vector>

#include "core/view/view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Smallest and largest angle at the corners of a planar element, or between the faces of a volume element (dihedral angles), degrees.
struct AngleSpan {
  double smallest, largest;
};
/// Angles of an element; none while a device has the positions.
[[nodiscard]] std::optional<AngleSpan> angles_of(const Frame& frame, Index element);

struct PickedFacts {
  Picked picked;        // the pick; nothing: there are no facts
  std::string trouble;  // reason why there are no facts although something is picked

  // Facts of a vertex
  Vec3 at;
  double now = 0.0, before = 0.0;   // minimum over its star of the shown metric; +infinity without elements
  std::vector<RankedElement> star;  // elements of the star, in its order

  // Facts of an element
  struct Row {
    const MetricInfo* metric;
    double now, before;  // NaN if the metric is not defined for its kind
  };
  std::vector<Row> metrics;  // metrics that are defined for its kind, and the shown one
  bool inverted = false;
  std::optional<Vec3> inverted_inside;          // point inside at which it is inverted, if its corners do not tell
  std::optional<AngleSpan> angles;              // angles of an element that is not inverted
  std::optional<double> aspect, target_aspect;  // longest over shortest axis, if the shown metric has a target
};

/// Facts of the pick. Never throws: anything that a device does not tell is explained in `trouble`.
[[nodiscard]] PickedFacts facts_of(const Frame& frame, const Picked& picked);

}  // namespace dmoscope::ui
