#pragma once
// The Jacobian determinant inside elements, at given places: implemented apart from the program's.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::test {

/// The least determinant at 9^3 places of a hexahedron or wedge, or as many as there are parts, corners among them; +infinity for other
/// kinds.
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

/// The number of elements with a place among these where the determinant is not positive.
inline Index inverted_inside(const Mesh& mesh, std::span<const Vec3> at) {
  Index count = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e)
    count += least_inside(mesh.elements.kind(e), mesh.elements.corners(e), at) <= 0.0 ? 1 : 0;
  return count;
}

/// n^3 cells of a block that is turned along its axis, jittered as far as all elements stay valid, so that many are nearly invalid.
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
      valid = valid && least > 1e-4 / (n * n * n);  // so that it is positive between these places, too
    }
    if (valid) return mesh;
  }
}

/// Hexahedra of a block whose cells are counted by i, j and k, with vertices at place(u, v, w) for the unit cube; along u it may close to a
/// ring. Its inner vertices are moved by up to `jitter`, the same way for the same seed.
template <class Place>
Mesh bent_block(std::array<Index, 3> cells, bool ring, const Place& place, double jitter, unsigned seed) {
  Mesh mesh;
  std::mt19937 random(seed);
  const auto offset = [&] { return jitter * (static_cast<double>(random()) / 4294967296.0 * 2.0 - 1.0); };
  const Index nu = cells[0], nv = cells[1], nw = cells[2];
  const Index columns = ring ? nu : nu + 1;
  for (Index k = 0; k <= nw; ++k)
    for (Index j = 0; j <= nv; ++j)
      for (Index i = 0; i < columns; ++i) {
        Vec3 p = place(static_cast<double>(i) / nu, static_cast<double>(j) / nv, static_cast<double>(k) / nw);
        if ((ring || (i > 0 && i < nu)) && j > 0 && j < nv && k > 0 && k < nw) p = p + Vec3{offset(), offset(), offset()};
        mesh.positions.push_back(p);
      }
  const auto at = [&](Index i, Index j, Index k) { return (k * (nv + 1) + j) * columns + i % columns; };
  for (Index k = 0; k < nw; ++k)
    for (Index j = 0; j < nv; ++j)
      for (Index i = 0; i < nu; ++i)
        mesh.elements.add(ElementKind::Hexahedron,
                          std::array{at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1), at(i, j, k),
                                     at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)});
  return mesh;
}

/// The thin wall of a can, three hexahedra thick, dented from one side and folded: some of them are inverted.
inline Mesh crushed_can(double dent, double fold, unsigned seed) {
  const auto place = [&](double u, double v, double w) {
    const double a = 2.0 * std::numbers::pi * u, z = 3.0 * w, near = (std::cos(a) - 1.0) * (std::cos(a) - 1.0) + std::sin(a) * std::sin(a);
    const double r = 1.0 + 0.08 * v - dent * std::exp(-2.0 * near - 4.0 * (z - 1.5) * (z - 1.5)) +
                     0.3 * fold * std::cos(5.0 * a) * std::sin(6.0 * std::numbers::pi * w);
    const double drop = fold * v * std::sin(3.0 * a) * std::exp(-25.0 * (w - 0.5) * (w - 0.5));
    return Vec3{r * std::cos(a), r * std::sin(a), z + drop};
  };
  return bent_block({16, 3, 8}, true, place, 0.02, seed);
}

/// A round rod, bent round a circle that it nearly fills and turned along its axis, jittered as far as all of it stays valid.
inline Mesh bent_rod(double turns, double radius, double twist, unsigned seed) {
  const auto place = [&](double u, double v, double w) {
    const double a = 2.0 * std::numbers::pi * turns * w, x = u - 0.5, y = v - 0.5, c = std::cos(twist * w), s = std::sin(twist * w);
    const double round_x = x * std::sqrt(1.0 - 2.0 * y * y), round_y = y * std::sqrt(1.0 - 2.0 * x * x);
    const double r = radius + c * round_x - s * round_y;
    return Vec3{r * std::cos(a), r * std::sin(a), s * round_x + c * round_y + 1.3 * turns * w};
  };
  for (double jitter = 0.12;; jitter *= 0.95) {
    Mesh mesh = bent_block({4, 4, 10}, false, place, jitter, seed);
    bool valid = true;
    for (Index e = 0; valid && e < mesh.elements.size(); ++e)
      valid = least_inside(mesh.elements.kind(e), mesh.elements.corners(e), mesh.positions) > 1e-6;
    if (valid) return mesh;
  }
}

}  // namespace dmoscope::test
