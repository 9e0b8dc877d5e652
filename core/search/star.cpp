#include "core/search/star.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmoscope {

namespace {

/// Bounding box of the star's other vertices, in plane offsets from the vertex.
struct Box {
  Vec2<double> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  void add(Vec2<double> p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] double farthest() const { return std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(high.x), std::fabs(high.y)}); }
};

/// Offsets of the element's other corners from its corner `corner`, in the element's order. Returns how many.
std::size_t other_corners(const QualityContext& context, PositionView positions, Incidence at, Vec3 origin,
                          std::array<Vec2<double>, 3>& out) {
  const auto corners = context.mesh.elements.corners(at.element);
  const std::size_t n = corners.size();
  for (std::size_t i = 1; i < n; ++i) out[i - 1] = context.geometry.plane.project(positions[corners[(at.corner + i) % n]] - origin);
  return n - 1;
}

Vec2<double> scaled(Vec2<double> p, double inverse) { return {p.x * inverse, p.y * inverse}; }

}  // namespace

void gather_star(const QualityContext& context, const Topology& topology, PositionView positions, std::span<const double> reference_measure,
                 Index vertex, Star<double>& star) {
  star.triangles.clear();
  star.quadrilaterals.clear();
  const Vec3 origin = positions[vertex];
  std::array<Vec2<double>, 3> others;
  Box box;
  for (const Incidence& at : topology.star(vertex)) {
    const std::size_t n = other_corners(context, positions, at, origin, others);
    for (std::size_t i = 0; i < n; ++i) box.add(others[i]);
  }
  const double extent = box.farthest();
  star.scale = extent > 0.0 && std::isfinite(extent) ? std::exp2(std::ilogb(extent)) : 1.0;
  const double inverse = 1.0 / star.scale;
  star.box = scaled(box.high - box.low, inverse);
  for (const Incidence& at : topology.star(vertex)) {
    const std::size_t n = other_corners(context, positions, at, origin, others);
    const double reference = reference_measure[at.element] * inverse * inverse;
    const Vec2<double> b = scaled(others[0], inverse), c = scaled(others[1], inverse);
    if (n == 2)
      star.triangles.push_back({b, c, reference});
    else
      star.quadrilaterals.push_back({b, c, scaled(others[2], inverse), reference});
  }
}

}  // namespace dmoscope
