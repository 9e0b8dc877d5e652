#pragma once
// Visits many vertices at once, one per slot of a pack: the same code compiled for several processors, chosen at run time.

#include <cstddef>
#include <cstdint>

#include "core/quality/metric.h"
#include "core/search/parameters.h"
#include "core/smooth/kernels/search_frame.h"
#include "core/smooth/kernels/star_table.h"

namespace dmoscope {

/// Task of a kernel, as plain data. Ranks: see StarTable.
struct LaneTask {
  const StarShape* shapes;
  const Index* others;
  double* ranked;       // positions, 3 numbers per rank
  std::uint8_t* awake;  // one per rank: whether its star has changed since it was last found at its best
  SearchFrame frame;
  SearchParameters parameters;
  const double* targets;              // targets of elements that have any: see StarTargets; else null
  const std::uint32_t* first_target;  // offset of a star's targets, by rank; else null

  /// Mean ratio above which a star keeps the guard; -infinity: there is no guard; infinity: each move must be confirmed.
  double guarded_above;
  void* owner;  // for the two below
  /// Returns, exactly, whether the vertex of this rank would gain by standing at `position` (3 coordinates). A guard may change the
  /// position. Leaves the vertex in its place.
  bool (*gains)(void* owner, Index rank, double* position);
  /// Visits the vertex of this rank as the reference does; true if it moved.
  bool (*visit_alone)(void* owner, Index rank);
};

/// Visits the ranks [first, last), no two of which share an element, as far as they are awake, and wakes their neighbours where they
/// move. Returns how many moved.
using LaneKernel = std::uint64_t (*)(const LaneTask& task, std::size_t first, std::size_t last);

/// Number of visits that a call of a kernel should make: enough to fill its lanes, few enough to share among threads.
inline constexpr std::size_t kLaneGrain = 1024;

}  // namespace dmoscope
