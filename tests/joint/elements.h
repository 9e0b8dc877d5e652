#pragma once
// Random elements of every kind, for tests of their atoms.

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/atoms.h"
#include "core/quality/quality.h"
#include "tests/support/meshes.h"

namespace dmoscope::testing {

/// Corners of the ideal element of a kind, but for their scale.
inline std::vector<Vec3> ideal_corners(ElementKind kind) {
  const double h = std::sqrt(3.0) / 2.0;
  switch (kind) {
    case ElementKind::Triangle:
      return {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}};
    case ElementKind::Quadrilateral:
      return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    case ElementKind::Tetrahedron:
      return {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0.5, h / 3.0, std::sqrt(2.0 / 3.0)}};
    case ElementKind::Hexahedron:
      return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    case ElementKind::Wedge:
      return {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, h, 1}};
    case ElementKind::Pyramid:
      return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}};
  }
  return {};
}

/// Element with its corners displaced at random by up to `jitter` edges.
inline Mesh random_element(ElementKind kind, double jitter, Random& random) {
  Mesh mesh;
  mesh.positions = ideal_corners(kind);
  std::vector<Index> corners;
  for (Vec3& p : mesh.positions) {
    corners.push_back(static_cast<Index>(corners.size()));
    p = p + Vec3{random(-jitter, jitter), random(-jitter, jitter), info(kind).dimension == 3 ? random(-jitter, jitter) : 0.0};
  }
  mesh.elements.add(kind, corners);
  return mesh;
}

template <int D>
std::vector<Atom<D>> atoms_of(const Mesh& mesh, Metric metric) {
  std::vector<Atom<D>> atoms;
  for (Index e = 0; e < mesh.elements.size(); ++e) append_atoms<D>(mesh.elements, metric, e, atoms);
  return atoms;
}

template <int D>
AtomEdges<D> edges_of(const Atom<D>& atom, std::span<const Vec3> positions) {
  AtomEdges<D> edges{};
  for (std::size_t j = 0; j < D; ++j) {
    const Vec3 e = positions[atom.vertices[j + 1]] - positions[atom.vertices[0]];
    edges[j][0] = e.x;
    edges[j][1] = e.y;
    if constexpr (D == 3) edges[j][2] = e.z;
  }
  return edges;
}

/// Compares gradient and Hessian with central differences of the value and of the gradient.
template <int D>
void expect_derivatives(const AtomFunction<D>& function, const Atom<D>& atom, const AtomEdges<D>& edges, double reference) {
  constexpr std::size_t kCount = AtomDerivatives<D>::kCount;
  AtomDerivatives<D> at, above, below;
  function.derive(atom, edges, reference, Curvature::Exact, at);
  EXPECT_NEAR(at.value, function.value(atom, edges, reference), 1e-13 * (1.0 + std::fabs(at.value)));
  constexpr double kStep = 1e-5;
  double scale = 1.0;
  for (const double h : at.hessian) scale = std::max(scale, std::fabs(h));
  for (std::size_t i = 0; i < kCount; ++i) {
    AtomEdges<D> moved = edges;
    moved[i / D][i % D] = edges[i / D][i % D] + kStep;
    function.derive(atom, moved, reference, Curvature::Exact, above);
    moved[i / D][i % D] = edges[i / D][i % D] - kStep;
    function.derive(atom, moved, reference, Curvature::Exact, below);
    EXPECT_NEAR(at.gradient[i], (above.value - below.value) / (2.0 * kStep), 1e-7 * scale);
    for (std::size_t j = 0; j < kCount; ++j) {
      EXPECT_NEAR(at.hessian[i * kCount + j], (above.gradient[j] - below.gradient[j]) / (2.0 * kStep), 1e-6 * scale);
      EXPECT_NEAR(at.hessian[i * kCount + j], at.hessian[j * kCount + i], 1e-12 * scale);
    }
  }
}

inline Geometry geometry_of(ElementKind kind) {
  Geometry geometry;
  geometry.shape = info(kind).dimension == 3 ? Shape::Volume : Shape::Planar;
  return geometry;
}

}  // namespace dmoscope::testing
