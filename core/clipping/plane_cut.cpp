#include "core/clipping/plane_cut.h"

#include <array>

namespace dmoscope {

namespace {

constexpr std::size_t kMostCorners = 8;

/// A line across a face, from one cut edge to another, each given by its local corners, the kept one first.
struct Crossing {
  std::array<Index, 2> from, to;
};

/// Lines across the faces of an element: up to 6 faces with at most two lines each.
struct Crossings {
  std::array<Crossing, 12> all{};
  std::size_t count = 0;
};

/// Finds the lines across all faces. Around a face seen from outside, a line begins where the walk returns from beyond and ends where it
/// went there, so the lines of neighbouring faces join: each cut edge is walked in both directions.
Crossings crossings_of(ElementKind kind, const std::array<bool, kMostCorners>& beyond) {
  Crossings crossings;
  for (const LocalFace& face : faces_of(kind)) {
    const Index n = face.count;
    for (Index i = 0; i < n; ++i) {
      const Index a = face.corners[i], b = face.corners[(i + 1) % n];
      if (beyond[a] || !beyond[b]) continue;
      for (Index k = 1; k < n; ++k) {
        const Index c = face.corners[(i + k) % n], d = face.corners[(i + k + 1) % n];
        if (!beyond[c] || beyond[d]) continue;
        crossings.all[crossings.count++] = {{d, c}, {a, b}};
        break;
      }
    }
  }
  return crossings;
}

}  // namespace

void cut_element(const ElementTable& elements, std::span<const Vec3> positions, Index element, const ClipPlane& plane, double shrink,
                 PlaneCuts& cuts) {
  if (info(elements.kind(element)).dimension != 3) return;  // a plane cuts a surface along a line
  const auto corners = elements.corners(element);
  std::array<Vec3, kMostCorners> points{};
  Vec3 mean{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points[i] = positions[corners[i]];
    mean = mean + points[i];
  }
  mean = 1.0 / static_cast<double>(corners.size()) * mean;
  std::array<double, kMostCorners> height{};
  std::array<bool, kMostCorners> beyond{};
  bool any = false, all = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (shrink < 1.0) points[i] = mean + shrink * (points[i] - mean);
    height[i] = plane.beyond(points[i]);
    beyond[i] = height[i] > 0.0;
    any = any || beyond[i];
    all = all && beyond[i];
  }
  if (!any || all) return;
  Crossings crossings = crossings_of(elements.kind(element), beyond);
  const auto point_on = [&](const std::array<Index, 2>& edge) {
    // Orders the ends, so that all elements around an edge get the same bits.
    auto [a, b] = edge;
    if (corners[a] > corners[b]) std::swap(a, b);
    return points[a] + height[a] / (height[a] - height[b]) * (points[b] - points[a]);
  };
  while (crossings.count > 0) {
    CutPolygon polygon{element, static_cast<Index>(cuts.points.size()), 0};
    Crossing at = crossings.all[--crossings.count];
    const auto start = at.from;
    for (;;) {
      cuts.points.push_back(point_on(at.from));
      ++polygon.count;
      if (at.to == start) break;
      std::size_t next = 0;
      while (next < crossings.count && crossings.all[next].from != at.to) ++next;
      if (next == crossings.count) break;  // impossible in an element whose faces close
      at = crossings.all[next];
      crossings.all[next] = crossings.all[--crossings.count];
    }
    if (polygon.count >= 3) {
      cuts.polygons.push_back(polygon);
    } else {
      cuts.points.resize(polygon.first);
    }
  }
}

}  // namespace dmoscope
