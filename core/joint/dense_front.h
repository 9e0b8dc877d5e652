#pragma once
// The dense part of a sparse Cholesky factorisation: some columns are eliminated from a symmetric matrix.

#include <cstddef>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/numeric/simd.h"

namespace dmoscope {

/// The lower half of a symmetric matrix of `height` rows, column by column: the first `width` columns, which are eliminated, with all rows;
/// and of the others the rows from `width` on. What is above the diagonal is of no account, and written to.
struct DenseFront {
  std::size_t height, width;
  double* pivots;
  double* rest;
  /// Of column j, such that its row i is at [i].
  [[nodiscard]] double* column(std::size_t j) const {
    return j < width ? pivots + j * height : rest + (j - width) * (height - width) - width;
  }
};

/// Its first columns become those of the Cholesky factor, the rest what is left to factorise. False where a pivot is not positive; the
/// front is in any state then. `room` is room to work in; `pool` may be null. Every sum has the same order for any level and any number of
/// threads: the same bits.
[[nodiscard]] bool eliminate(const DenseFront& front, std::vector<double>& room, SimdLevel level, ThreadPool* pool);

}  // namespace dmoscope
