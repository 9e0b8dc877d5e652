#include "core/inspect/target_shape.h"

#include <algorithm>
#include <cmath>

#include "core/quality/defined_judge.h"

namespace dmoscope {

double TargetShapeOfElement::aspect(const SmallMatrix& map) {
  const Eigen e = eigen(map * transposed(map));
  double least = e.values[0], most = e.values[0];
  for (std::size_t i = 1; static_cast<int>(i) < map.n; ++i) {
    least = std::min(least, e.values[i]);
    most = std::max(most, e.values[i]);
  }
  return least > 0.0 ? std::sqrt(most / least) : HUGE_VAL;
}

std::optional<TargetShapeOfElement> target_shape(const InputMesh& input, PositionView positions, Metric metric, Index element) {
  if (is_built_in(metric)) return std::nullopt;
  const auto judge = input.quality_context().judge(metric);
  const ElementTarget target = judge->targets().of(element);
  if (target.space == FormulaSpace::Plain) return std::nullopt;
  const ElementKind kind = input.mesh.elements.kind(element);
  const int n = info(kind).dimension;
  std::array<Vec3, 8> places{};
  const auto corners = input.mesh.elements.corners(element);
  ElementFrames{input.geometry, input.surface_normals}.gather(
      corners, element, n, [&](Index v) { return positions[v]; }, places);
  const auto matrix = [&](std::size_t which) {
    SmallMatrix m{n, {}};
    for (std::size_t i = 0; static_cast<int>(i) < n; ++i)
      for (std::size_t j = 0; static_cast<int>(j) < n; ++j)
        m.at[i][j] = target.matrices[which * static_cast<std::size_t>(n * n) + i * static_cast<std::size_t>(n) + j];
    return m;
  };
  const SmallMatrix ideal = ideal_edges(kind), to_ideal = inverse(ideal);
  TargetShapeOfElement shape{{n, {}}, {n, {}}};
  const std::size_t count = matrix_count(kind);
  for (std::size_t corner = 0; corner < count; ++corner) {
    const SmallMatrix edges = edges_at(kind, places, corner), now = edges * to_ideal;
    if (!(determinant(now) > 0.0)) return std::nullopt;
    shape.now = shape.now + scaled(1.0 / static_cast<double>(count), now);
    // The wished map: edges times the target's matrix are the ideal edges but for a rotation, which the polar decomposition gives.
    const SmallMatrix wished = target.space == FormulaSpace::Stretched
                                   ? inverse(matrix(0))
                                   : polar(edges * matrix(corner) * to_ideal).rotation * ideal * inverse(matrix(corner)) * to_ideal;
    shape.wished = shape.wished + scaled(1.0 / static_cast<double>(count), wished);
  }
  return shape;
}

}  // namespace dmoscope
