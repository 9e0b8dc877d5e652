#pragma once
// Meshes made by hand for the tests.

#include <cmath>
#include <initializer_list>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope::test {

inline void add(Mesh& mesh, std::initializer_list<Index> corners) {
  const std::vector<Index> c(corners);
  mesh.elements.add(c.size() == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, c);
}

inline Mesh make(std::initializer_list<Vec3> positions, std::initializer_list<std::initializer_list<Index>> elements) {
  Mesh mesh;
  mesh.positions.assign(positions);
  for (const auto& corners : elements) add(mesh, corners);
  return mesh;
}

/// nx x ny cells of unit size, quadrilaterals where (column + row) % every == 0, else two triangles. every = 1: all quadrilaterals.
inline Mesh lattice(Index nx, Index ny, Index every) {
  Mesh mesh;
  for (Index j = 0; j <= ny; ++j) {
    for (Index i = 0; i <= nx; ++i) mesh.positions.push_back({double(i), double(j), 0.0});
  }
  for (Index j = 0; j < ny; ++j) {
    for (Index i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i;
      const Index b = a + 1;
      const Index c = b + nx + 1;
      const Index d = a + nx + 1;
      if ((i + j) % every == 0) {
        add(mesh, {a, b, c, d});
      } else {
        add(mesh, {a, b, c});
        add(mesh, {a, c, d});
      }
    }
  }
  return mesh;
}

/// A lattice with holes: cells for which keep() is false are left out.
template <class Keep>
Mesh with_holes(Index n, Keep keep) {
  Mesh mesh = lattice(n, n, 1);
  const ElementTable all = mesh.elements;
  mesh.elements = {};
  for (Index e = 0; e < all.size(); ++e) {
    if (keep(e % n, e / n)) mesh.elements.add(all.kind(e), all.corners(e));
  }
  return mesh;
}

/// A strip of n quadrilaterals closed to a band; `twisted` glues its ends the wrong way round (Moebius).
inline Mesh band(Index n, bool twisted) {
  Mesh mesh;
  for (Index i = 0; i < n; ++i) {
    const double t = 6.283185307179586 * i / n;
    mesh.positions.push_back({std::cos(t), std::sin(t), 0});
    mesh.positions.push_back({2 * std::cos(t), 2 * std::sin(t), 0.1 * std::sin(t)});
  }
  for (Index i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const Index inner = last ? (twisted ? 1 : 0) : 2 * i + 2;
    const Index outer = last ? (twisted ? 0 : 1) : 2 * i + 3;
    add(mesh, {2 * i, 2 * i + 1, outer, inner});
  }
  return mesh;
}

}  // namespace dmoscope::test
