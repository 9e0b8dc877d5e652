#pragma once
// Blocks of volume elements over the unit cube.

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope::test {

/// Elements that the cells of a block are split into.
enum class Fill { Hexahedra, Tetrahedra, Mixed, Wedges };

/// n x n x n cells over the unit cube: hexahedra, six tetrahedra each along the same diagonal, two wedges each, or by columns hexahedra,
/// two wedges, or six pyramids about a vertex of their own. Inner vertices are moved by up to `jitter` cells, the same way for the same
/// seed.
inline Mesh volume_grid(Index n, Fill fill, double jitter = 0.0, unsigned seed = 1) {
  Mesh mesh;
  std::mt19937 random(seed);
  const auto offset = [&] { return jitter * (static_cast<double>(random()) / 4294967296.0 * 2.0 - 1.0); };
  const auto at = [n](Index i, Index j, Index k) { return (k * (n + 1) + j) * (n + 1) + i; };
  const double size = 1.0 / static_cast<double>(n);
  mesh.positions.reserve(std::size_t{n + 1} * (n + 1) * (n + 1));
  for (Index k = 0; k <= n; ++k) {
    for (Index j = 0; j <= n; ++j) {
      for (Index i = 0; i <= n; ++i) {
        const bool inner = i > 0 && j > 0 && k > 0 && i < n && j < n && k < n;
        Vec3 place{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        if (inner && jitter > 0.0) place = place + Vec3{offset(), offset(), offset()};
        mesh.positions.push_back(size * place);
      }
    }
  }
  const std::size_t cells = std::size_t{n} * n * n;
  mesh.elements.reserve(fill == Fill::Tetrahedra ? 6 * cells : cells, fill == Fill::Tetrahedra ? 24 * cells : 8 * cells);
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) {
        const std::array<Index, 8> c{at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
                                     at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
        const auto add = [&](ElementKind kind, std::initializer_list<Index> corners) {
          mesh.elements.add(kind, std::vector<Index>(corners));
        };
        if (fill == Fill::Tetrahedra) {
          for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}) {
            add(ElementKind::Tetrahedron, {c[0], c[static_cast<std::size_t>(a)], c[static_cast<std::size_t>(b)], c[6]});
          }
        } else if (fill == Fill::Hexahedra || (fill == Fill::Mixed && (i + j) % 3 == 0)) {
          mesh.elements.add(ElementKind::Hexahedron, c);
        } else if (fill == Fill::Wedges || (i + j) % 3 == 1) {
          add(ElementKind::Wedge, {c[0], c[1], c[2], c[4], c[5], c[6]});
          add(ElementKind::Wedge, {c[0], c[2], c[3], c[4], c[6], c[7]});
        } else {
          const auto tip = static_cast<Index>(mesh.positions.size());
          Vec3 mean{};
          for (const Index v : c) mean = mean + 0.125 * mesh.positions[v];
          mesh.positions.push_back(mean);
          for (const auto& q : {std::array{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}) {
            const auto corner = [&](std::size_t m) { return c[static_cast<std::size_t>(q[m])]; };
            add(ElementKind::Pyramid, {corner(0), corner(1), corner(2), corner(3), tip});
          }
        }
      }
    }
  }
  return mesh;
}

}  // namespace dmoscope::test
