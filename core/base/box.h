#pragma once
// Axis-parallel bounding boxes.

#include <algorithm>
#include <limits>
#include <span>

#include "core/base/vec.h"

namespace dmoscope {

/// Bounding box of points, empty until one is added.
struct PointBox {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec3 high{-low.x, -low.y, -low.z};
  void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

[[nodiscard]] inline PointBox box_of(std::span<const Vec3> points) {
  PointBox box;
  for (const Vec3& p : points) box.add(p);
  return box;
}

}  // namespace dmoscope
