#pragma once
// The nearest positive semidefinite matrix to a small symmetric one.

#include <array>
#include <cmath>
#include <cstddef>

namespace dmoscope {

/// Sets the negative eigenvalues of a symmetric matrix to 0, which gives the nearest positive semidefinite one in the Frobenius norm
/// (Higham 1988). `a`: N x N, row by row. By Jacobi's rotations in a fixed order: equal bits on every processor.
template <std::size_t N>
void make_semidefinite(std::array<double, N * N>& a) {
  std::array<double, N*N> work = a, vectors{};
  for (std::size_t i = 0; i < N; ++i) vectors[i * N + i] = 1.0;
  // Rotates rows and columns p and q of `work` so that their off-diagonal entry is 0, and the vectors with them.
  const auto rotate = [&work, &vectors](std::size_t p, std::size_t q) {
    const double coupling = work[p * N + q];
    const double ratio = (work[q * N + q] - work[p * N + p]) / (2.0 * coupling);
    const double t = (ratio < 0.0 ? -1.0 : 1.0) / (std::fabs(ratio) + std::sqrt(ratio * ratio + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    const auto turn = [c, s](double& x, double& y) {
      const double old = x;
      x = c * old - s * y;
      y = s * old + c * y;
    };
    for (std::size_t k = 0; k < N; ++k) turn(work[k * N + p], work[k * N + q]);
    for (std::size_t k = 0; k < N; ++k) turn(work[p * N + k], work[q * N + k]);
    for (std::size_t k = 0; k < N; ++k) turn(vectors[k * N + p], vectors[k * N + q]);
  };
  for (int sweep = 0; sweep < 30; ++sweep) {
    bool turned = false;
    for (std::size_t p = 0; p + 1 < N; ++p)
      for (std::size_t q = p + 1; q < N; ++q) {
        const double coupling = work[p * N + q];
        if (!(coupling * coupling > 1e-32 * std::fabs(work[p * N + p] * work[q * N + q])) || coupling == 0.0) continue;
        rotate(p, q);
        turned = true;
      }
    if (!turned) break;
  }
  for (std::size_t k = 0; k < N; ++k) {
    const double eigenvalue = work[k * N + k];
    if (!(eigenvalue < 0.0)) continue;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) a[i * N + j] -= eigenvalue * vectors[i * N + k] * vectors[j * N + k];
  }
}

}  // namespace dmoscope
