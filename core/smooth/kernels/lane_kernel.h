#pragma once
// Visits many vertices at once, one per slot of a pack: the same code compiled for several processors, chosen at run time.

#include <cstddef>
#include <cstdint>

#include "core/quality/metric.h"
#include "core/search/parameters.h"
#include "core/smooth/kernels/search_frame.h"
#include "core/smooth/kernels/star_table.h"

namespace dmoscope {

/// All a kernel needs to know, as plain data. Ranks: see StarTable.
struct LaneTask {
  const StarShape* shapes;
  const Index* others;
  double* ranked;       // 3 per rank: the positions
  std::uint8_t* awake;  // one per rank: has its star changed since it was last found at its best?
  SearchFrame frame;
  SearchParameters parameters;
  const double* targets;              // of elements that have targets: see StarTargets; else null
  const std::uint32_t* first_target;  // likewise, by rank

  void* owner;      // for the two below
  bool is_guarded;  // must every move be asked for?
  /// Exactly: would the vertex of this rank gain by standing at `position` (3 coordinates)? A guard may change the position. Leaves the
  /// vertex where it is.
  bool (*gains)(void* owner, Index rank, double* position);
  /// The reference's visit of the vertex of this rank; true if it moved.
  bool (*visit_alone)(void* owner, Index rank);
};

/// Visits the ranks [first, last), no two of which share an element, as far as they are awake, and wakes their neighbours where they
/// move. Returns how many moved.
using LaneKernel = std::uint64_t (*)(const LaneTask& task, std::size_t first, std::size_t last);

/// Visits a call of a kernel should make: enough to fill its lanes, few enough to share among threads.
inline constexpr std::size_t kLaneGrain = 1024;

}  // namespace dmoscope
