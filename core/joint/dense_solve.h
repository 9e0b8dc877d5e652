#pragma once
// Dense part of solving with a sparse Cholesky factor, for one or two right-hand sides: the factor is read from memory once for both.

#include <array>
#include <cstddef>

namespace dmoscope {

/// Columns of a factor with all their rows, column by column: see DenseFront.
struct FactorColumns {
  const double* entries;
  std::size_t height, width;
};

/// Solves for the first `width` rows by L, and subtracts their share from the others. x: the front's rows of each right-hand side.
template <std::size_t Q>
void solve_lower(const FactorColumns& l, const std::array<double*, Q>& x);
/// Solves for the first `width` rows by the transpose of L; the others are known.
template <std::size_t Q>
void solve_upper(const FactorColumns& l, const std::array<double*, Q>& x);

}  // namespace dmoscope
