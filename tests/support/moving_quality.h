#pragma once
// Quality of the parts that a vertex of a volume changes, judged without the code under test: every corner as the element that its three
// edges span. That is an affine image of the ideal one, all of whose corners are alike, so that the judge of whole elements gives the
// corner's quality.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/input/input_mesh.h"
#include "core/quality/formulas.h"
#include "core/quality/quality.h"

namespace dmoscope::testing {

/// The volume elements that three edges span.
struct Spanned {
  Vec3 a, u, v, w;
  [[nodiscard]] formulas::Hexahedron<Vec3> hexahedron() const {
    return {{a, a + u, a + u + v, a + v, a + w, a + u + w, a + u + v + w, a + v + w}};
  }
  [[nodiscard]] formulas::Wedge<Vec3> wedge() const { return {{a, a + u, a + v, a + w, a + u + w, a + v + w}}; }
  [[nodiscard]] formulas::Pyramid<Vec3> pyramid() const { return {{a, a + u, a + u + v, a + v, a + w}}; }
};

/// The quality of one corner, as that of an affine element which the corner spans. The scaled Jacobian depends on the edges' lengths, and
/// those of an affine wedge or pyramid differ elsewhere; so it is taken from the hexahedron, over the value at the ideal corner.
template <Metric M>
double corner_quality(const Spanned& corner, ElementKind kind) {
  constexpr bool kOfLengths = M == Metric::ScaledJacobian;
  if (kind == ElementKind::Wedge)
    return kOfLengths ? formulas::metric<M>(corner.hexahedron()) / std::sqrt(0.75) : formulas::metric<M>(corner.wedge());
  if (kind == ElementKind::Pyramid)
    return kOfLengths ? formulas::metric<M>(corner.hexahedron()) / std::sqrt(0.5) : formulas::metric<M>(corner.pyramid());
  return formulas::metric<M>(corner.hexahedron());
}

template <Metric M, class Corners>
double least_moving_corner(std::span<const Index> corners, ElementKind kind, PositionView positions, Index vertex) {
  double least = std::numeric_limits<double>::infinity();
  for (const CornerTable& row : Corners::kTable) {
    if (std::ranges::none_of(row, [&](std::uint8_t i) { return corners[i] == vertex; })) continue;
    const auto at = [&](std::size_t i) { return positions[corners[row[i]]]; };
    const Vec3 a = at(0);
    least = std::min(least, corner_quality<M>({a, at(1) - a, at(2) - a, at(3) - a}, kind));
  }
  return least;
}

/// The least metric of the star over the parts that `vertex` changes: tetrahedra, and the corners of other volume elements at it or at the
/// end of an edge from it, and of pyramids with the tip. The metric must be defined for all of them.
inline double moving_quality(const InputMesh& input, PositionView positions, Metric metric, Index vertex) {
  const auto of_element = [&](Index element) {
    const auto corners = input.mesh.elements.corners(element);
    const ElementKind kind = input.mesh.elements.kind(element);
    if (kind == ElementKind::Tetrahedron) return element_quality(input.quality_context(), positions, metric, element);
    return formulas::with_volume_metric(metric, [&]<Metric M>() {
      if constexpr (formulas::kDefinedForCorners<M>) {
        if (kind == ElementKind::Hexahedron) return least_moving_corner<M, formulas::HexahedronCorners>(corners, kind, positions, vertex);
        if (kind == ElementKind::Wedge) return least_moving_corner<M, formulas::WedgeCorners>(corners, kind, positions, vertex);
        return least_moving_corner<M, formulas::PyramidCorners>(corners, kind, positions, vertex);
      } else {
        return std::numeric_limits<double>::quiet_NaN();
      }
    });
  };
  double quality = std::numeric_limits<double>::infinity();
  for (const Incidence& at : input.topology.star(vertex)) quality = std::min(quality, of_element(at.element));
  return quality;
}

}  // namespace dmoscope::testing
