#pragma once
// Dense part of a sparse Cholesky factorisation: some columns are eliminated from a symmetric matrix.

#include <cstddef>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/numeric/simd.h"

namespace dmoscope {

/// Lower half of a symmetric matrix of `height` rows, column by column: the first `width` columns, which are eliminated, with all rows; and
/// of the others the rows from `width` on. Entries above the diagonal are ignored, and written to.
struct DenseFront {
  std::size_t height, width;
  double* pivots;
  double* rest;
  /// Column j, such that its row i is at [i].
  [[nodiscard]] double* column(std::size_t j) const {
    return j < width ? pivots + j * height : rest + (j - width) * (height - width) - width;
  }
};

/// Makes the first columns those of the Cholesky factor, the rest the matrix that is left to factorise. False where a pivot is not
/// positive; the front is in any state then. `room`: work space; `pool` may be null. Every sum has the same order for any level and any
/// number of threads: the same bits.
[[nodiscard]] bool eliminate(const DenseFront& front, std::vector<double>& room, SimdLevel level, ThreadPool* pool);

}  // namespace dmoscope
