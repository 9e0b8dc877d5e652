#pragma once
// From an atom's metric on numbers that carry derivatives to the derivatives of what is minimised.

#include "core/joint/atoms.h"
#include "core/numeric/second_dual.h"
#include "core/numeric/semidefinite.h"

namespace dmoscope {

/// 1 / q, q > 0.
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
