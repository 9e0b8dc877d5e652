#pragma once
// Derivatives of the minimised function, from an atom's metric on numbers that carry derivatives.

#include "core/joint/atoms.h"
#include "core/numeric/second_dual.h"
#include "core/numeric/semidefinite.h"

namespace dmoscope {

/// Edges as vectors of a scalar that make(value, number of the variable) makes.
template <class R, class Make>
[[nodiscard]] std::array<Vec2<R>, 2> edge_vectors(const AtomEdges<2>& e, const Make& make) {
  return {Vec2<R>{make(e[0][0], 0), make(e[0][1], 1)}, Vec2<R>{make(e[1][0], 2), make(e[1][1], 3)}};
}
template <class R, class Make>
[[nodiscard]] std::array<Vec3Of<R>, 3> edge_vectors(const AtomEdges<3>& e, const Make& make) {
  return {Vec3Of<R>{make(e[0][0], 0), make(e[0][1], 1), make(e[0][2], 2)}, Vec3Of<R>{make(e[1][0], 3), make(e[1][1], 4), make(e[1][2], 5)},
          Vec3Of<R>{make(e[2][0], 6), make(e[2][1], 7), make(e[2][2], 8)}};
}
/// Edges as vectors of plain numbers.
template <std::size_t D>
[[nodiscard]] auto plain_vectors(const std::array<std::array<double, D>, D>& edges) {
  return edge_vectors<double>(edges, [](double x, std::size_t) { return x; });
}
template <std::size_t D>
[[nodiscard]] auto dual_vectors(const std::array<std::array<double, D>, D>& edges) {
  using R = SecondDual<D * D>;
  return edge_vectors<R>(edges, [](double x, std::size_t i) { return R::variable(x, i); });
}

/// Derivatives of 1 / q, q > 0.
template <int D>
void derive_inverse(const SecondDual<AtomDerivatives<D>::kCount>& q, Curvature curvature, AtomDerivatives<D>& result) {
  constexpr std::size_t kCount = AtomDerivatives<D>::kCount;
  const double f = 1.0 / q.value;
  const auto inverse = q.through(f, -f * f, 2.0 * f * f * f);
  result.value = f;
  result.gradient = inverse.first;
  for (std::size_t i = 0; i < kCount; ++i)
    for (std::size_t j = 0; j < kCount; ++j) result.hessian[i * kCount + j] = inverse.second_by(i, j);
  if (curvature == Curvature::Convex) make_semidefinite<kCount>(result.hessian);
}

template <int D>
void scale_derivatives(double factor, AtomDerivatives<D>& result) {
  result.value *= factor;
  for (double& x : result.gradient) x *= factor;
  for (double& x : result.hessian) x *= factor;
}

}  // namespace dmoscope
