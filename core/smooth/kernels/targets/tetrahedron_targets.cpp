#include "core/smooth/kernels/targets/tetrahedron_targets.h"

#include <algorithm>
#include <cmath>

#include "core/base/memory.h"
#include "core/smooth/kernels/solid_target.h"

namespace dmoscope {

namespace {

/// Limit for K's mixing of one axis into another: floats lose the square of that.
constexpr double kMostOblique = 1e3;
/// Limit for the stretch of a target, along any axis: floats lose the square of that.
constexpr double kMostStretched = 3e3;

SmallMatrix matrix_at(const double* m) { return {3, {{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}}}; }

/// Turns columns i and j of a until a[i][j] is 0.
void turn(SmallMatrix& a, std::size_t i, std::size_t j) {
  const double size = std::hypot(a.at[i][i], a.at[i][j]);
  if (!(size > 0.0)) return;
  const double c = a.at[i][i] / size, s = a.at[i][j] / size;
  for (auto& row : a.at) {
    const double x = row[i], y = row[j];
    row[i] = c * x + s * y;
    row[j] = c * y - s * x;
  }
}

}  // namespace

TetrahedronTargets::TetrahedronTargets(const TargetTable& targets, const Mesh& mesh) {
  const auto count = static_cast<Index>(mesh.elements.size());
  for (Index e = 0; e < count && !crossed_; ++e) crossed_ = targets.of(e).space == FormulaSpace::Stretched;
  reserve_large(numbers_, count * volumes::solid_target_numbers(crossed_));
  fits_.reserve(count);
  for (Index e = 0; e < count; ++e) add(targets, mesh, e);
}

TetrahedronTargets::TetrahedronTargets(const TargetTable& targets, const Mesh& mesh, std::span<const Incidence> star) {
  for (Index e = 0; e < mesh.elements.size() && !crossed_; ++e) crossed_ = targets.of(e).space == FormulaSpace::Stretched;
  for (const Incidence& at : star) add(targets, mesh, at.element);
}

void TetrahedronTargets::add(const TargetTable& targets, const Mesh& mesh, Index element) {
  const std::size_t numbers = volumes::solid_target_numbers(crossed_);
  const ElementTarget target = targets.of(element);
  SmallMatrix left = SmallMatrix::identity(3);
  if (target.space == FormulaSpace::Stretched) left = matrix_at(target.matrices);
  const auto& k = left.at;
  const double oblique = std::max({std::abs(k[0][1]), std::abs(k[0][2]), std::abs(k[1][2])});
  const bool fits = mesh.elements.kind(element) == ElementKind::Tetrahedron && target.steepness == 1.0 &&
                    oblique < kMostOblique * std::min({k[0][0], k[1][1], k[2][2]}) &&
                    (target.matrices == nullptr || condition(matrix_at(target.matrices)) < kMostStretched);
  fits_.push_back(fits ? 1 : 0);
  if (!fits) {
    numbers_.resize(numbers_.size() + numbers);
    return;
  }
  any_ = true;
  SmallMatrix right = inverse(ideal_edges(ElementKind::Tetrahedron));
  if (target.space == FormulaSpace::Target) right = matrix_at(target.matrices) * right;
  const double size = 1.0 / std::cbrt(determinant(right)), stretch = 1.0 / std::cbrt(determinant(left));
  turn(right, 0, 1);
  turn(right, 0, 2);
  turn(right, 1, 2);
  const auto& g = right.at;
  for (const double number : {g[0][0], g[1][0], g[1][1], g[2][0], g[2][1], g[2][2]}) numbers_.push_back(size * number);
  if (!crossed_) return;
  for (const double number : {k[0][0], k[0][1], k[0][2], k[1][1], k[1][2], k[2][2]}) numbers_.push_back(stretch * number);
}

}  // namespace dmoscope
