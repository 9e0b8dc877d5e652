#pragma once
// What there is to read about the vertex or element that is picked, of a frame.

#include <optional>
#include <string>
#include <vector>

#include "core/view/view.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Smallest and largest angle at the corners of an element, degrees.
struct AngleSpan {
  double smallest, largest;
};
/// Of a triangle or quadrilateral; none of a volume element, or while a device has the positions.
[[nodiscard]] std::optional<AngleSpan> angles_of(const Frame& frame, Index element);

struct PickedFacts {
  Picked picked;        // what these are about; nothing: there is nothing to read
  std::string trouble;  // why there is nothing to read although something is picked

  // Of a vertex
  Vec3 at;
  double now = 0.0, before = 0.0;   // minimum over its star of the shown metric; +infinity without elements
  std::vector<RankedElement> star;  // its elements in the star's order

  // Of an element
  struct Row {
    const MetricInfo* metric;
    double now, before;  // NaN where the metric is not defined for its kind
  };
  std::vector<Row> metrics;
  bool inverted = false;
  std::optional<Vec3> inverted_inside;          // where, if its corners do not tell
  std::optional<AngleSpan> angles;              // of one that is not inverted, and no volume
  std::optional<double> aspect, target_aspect;  // longest over shortest axis, where the shown metric has a target
};

/// Never throws: what a device does not tell is said in `trouble`.
[[nodiscard]] PickedFacts facts_of(const Frame& frame, const Picked& picked);

}  // namespace dmoscope::ui
