#pragma once
// The Jacobian determinant inside elements, by places: written down apart from the program's own.

#include <algorithm>
#include <cmath>
#include <span>

#include "core/mesh/mesh.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::test {

/// Its least value at 9^3 places of a hexahedron or wedge, or as many as there are parts, corners among them; +infinity for other kinds.
inline double least_inside(ElementKind kind, std::span<const Index> v, std::span<const Vec3> at, int parts = 8) {
  double least = HUGE_VAL;
  const auto p = [&](std::size_t i) { return at[v[i]]; };
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; j <= parts; ++j)
      for (int k = 0; k <= parts; ++k) {
        const double x = static_cast<double>(i) / parts, y = static_cast<double>(j) / parts, z = static_cast<double>(k) / parts;
        if (kind == ElementKind::Hexahedron) {
          const auto mean = [](double s, double t, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
            return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
          };
          const Vec3 a = mean(y, z, p(1) - p(0), p(2) - p(3), p(5) - p(4), p(6) - p(7));
          const Vec3 b = mean(x, z, p(3) - p(0), p(2) - p(1), p(7) - p(4), p(6) - p(5));
          const Vec3 c = mean(x, y, p(4) - p(0), p(5) - p(1), p(7) - p(3), p(6) - p(2));
          least = std::min(least, dot(a, cross(b, c)));
        } else if (kind == ElementKind::Wedge && x + y <= 1) {
          const Vec3 a = (1 - z) * (p(1) - p(0)) + z * (p(4) - p(3)), b = (1 - z) * (p(2) - p(0)) + z * (p(5) - p(3));
          const Vec3 c = (1 - x - y) * (p(3) - p(0)) + x * (p(4) - p(1)) + y * (p(5) - p(2));
          least = std::min(least, dot(cross(a, b), c));
        }
      }
  return least;
}

/// The elements that have a place among these where it is not positive.
inline Index inverted_inside(const Mesh& mesh, std::span<const Vec3> at) {
  Index count = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e)
    count += least_inside(mesh.elements.kind(e), mesh.elements.corners(e), at) <= 0.0 ? 1 : 0;
  return count;
}

/// n^3 cells of a block that is turned along its axis, jittered by as much as leaves all elements valid, so that many are near to not
/// being.
inline Mesh twisted_block(Index n, Fill fill, unsigned seed) {
  for (double jitter = 0.42;; jitter *= 0.95) {
    Mesh mesh = volume_grid(n, fill, jitter, seed);
    for (Vec3& p : mesh.positions) {
      const double turn = 1.2 * p.z, x = p.x - 0.5, y = p.y - 0.5, wide = 1.0 + 1.5 * p.z * p.z;
      p = {wide * (std::cos(turn) * x - std::sin(turn) * y), std::cos(turn) * y + std::sin(turn) * x, p.z};
    }
    bool valid = true;
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      const double least = least_inside(mesh.elements.kind(e), mesh.elements.corners(e), mesh.positions);
      valid = valid && least > 1e-4 / (n * n * n);  // so that it is between these places, too
    }
    if (valid) return mesh;
  }
}

}  // namespace dmoscope::test
