#pragma once
// The boundary of a volume by plain geometry, for measurements in tests of sliding.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "core/mesh/faces.h"
#include "core/mesh/mesh.h"

namespace dmoscope::testing {

using Triangle = std::array<Index, 3>;

inline Vec3 unit(Vec3 a) { return length(a) > 0.0 ? (1.0 / length(a)) * a : Vec3{}; }

inline double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double t = dot(d, d) > 0.0 ? std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0) : 0.0;
  return length(p - (a + t * d));
}
/// Distance of a point to a triangle: to its plane if the point lies above the triangle, else to its sides.
inline double distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const double by_sides = std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const Vec3 n = unit(cross(b - a, c - a));
  const auto inside = [&](Vec3 from, Vec3 to) { return dot(cross(to - from, p - from), n) >= 0.0; };
  const bool above = inside(a, b) && inside(b, c) && inside(c, a) && length(n) > 0.5;
  return above ? std::min(by_sides, std::abs(dot(p - a, n))) : by_sides;
}

/// The faces of exactly one element, found by counting: each as its corners in order.
inline std::vector<std::vector<Index>> boundary_faces(const Mesh& mesh) {
  std::map<std::vector<Index>, std::vector<std::vector<Index>>> found;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    for (const LocalFace& face : faces_of(mesh.elements.kind(e))) {
      std::vector<Index> corners;
      for (const Index i : face.span()) corners.push_back(mesh.elements.corners(e)[i]);
      std::vector<Index> key = corners;
      std::ranges::sort(key);
      found[key].push_back(corners);
    }
  }
  std::vector<std::vector<Index>> faces;
  for (const auto& [key, same] : found)
    if (same.size() == 1) faces.push_back(same.front());
  return faces;
}

/// The boundary of a volume, or all of a surface.
inline std::vector<std::vector<Index>> surface_faces(const Mesh& mesh) {
  if (info(mesh.elements.kind(0)).dimension == 3) return boundary_faces(mesh);
  std::vector<std::vector<Index>> faces;
  for (Index e = 0; e < mesh.elements.size(); ++e) faces.emplace_back(mesh.elements.corners(e).begin(), mesh.elements.corners(e).end());
  return faces;
}

/// Triangles of faces, with quadrilaterals split by their shorter diagonals.
inline std::vector<Triangle> triangles_of(const std::vector<std::vector<Index>>& faces, std::span<const Vec3> positions) {
  std::vector<Triangle> all;
  for (const auto& f : faces) {
    if (f.size() == 3) {
      all.push_back({f[0], f[1], f[2]});
      continue;
    }
    const Vec3 one = positions[f[2]] - positions[f[0]], other = positions[f[3]] - positions[f[1]];
    if (dot(one, one) <= dot(other, other))
      all.push_back({f[0], f[1], f[2]}), all.push_back({f[0], f[2], f[3]});
    else
      all.push_back({f[0], f[1], f[3]}), all.push_back({f[1], f[2], f[3]});
  }
  return all;
}

inline double distance_to(Vec3 p, std::span<const Vec3> positions, const std::vector<Triangle>& triangles) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles) least = std::min(least, distance_to_triangle(p, positions[a], positions[b], positions[c]));
  return least;
}

/// The greatest distance of points of triangles from others: seven points of each, besides its corners.
inline double deviation(std::span<const Vec3> from, const std::vector<Triangle>& triangles, std::span<const Vec3> to,
                        const std::vector<Triangle>& others) {
  double most = 0.0;
  for (const auto& [a, b, c] : triangles)
    for (const auto& w :
         {std::array{1.0, 1.0, 1.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 1.0}, {1.0, 0.0, 1.0}, {4.0, 1.0, 1.0}, {1.0, 4.0, 1.0}, {1.0, 1.0, 4.0}})
      most = std::max(most, distance_to((1.0 / (w[0] + w[1] + w[2])) * (w[0] * from[a] + w[1] * from[b] + w[2] * from[c]), to, others));
  return most;
}

}  // namespace dmoscope::testing
