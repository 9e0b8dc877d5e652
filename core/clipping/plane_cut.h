#pragma once
// Cuts through cells by a plane.

#include <span>
#include <vector>

#include "core/clipping/clipped_view.h"
#include "core/mesh/faces.h"

namespace dmoscope {

/// A polygon in which a plane cuts a cell: points [first, first + count) of a list, counter-clockwise seen from the removed side.
struct CutPolygon {
  Index element;
  Index first, count;
  friend bool operator==(const CutPolygon&, const CutPolygon&) = default;
};

struct PlaneCuts {
  std::vector<CutPolygon> polygons;
  std::vector<Vec3> points;
  void clear() noexcept {
    polygons.clear();
    points.clear();
  }
};

/// Appends the polygons in which `plane` cuts an element that is shrunk about the mean of its vertices; more than one if the element is not
/// convex, none if it lies on one side. Edges count as straight, and faces as cut in straight lines from edge to edge.
void cut_element(const ElementTable& elements, std::span<const Vec3> positions, Index element, const ClipPlane& plane, double shrink,
                 PlaneCuts& cuts);

}  // namespace dmoscope
