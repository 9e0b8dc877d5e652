#pragma once
// Judging of a frame's elements.

#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/view/view.h"

namespace dmoscope {

/// Fills in everything that a frame shows of its elements, from its input, positions and metric, in one pass over them. `immovable`: see
/// immovable_elements; `pool` may be null.
void judge_elements(Frame& frame, std::span<const Index> immovable, ThreadPool* pool);

/// Spread of a metric over the input.
[[nodiscard]] InputSpread spread_of(const InputMesh& input, Metric metric, ThreadPool* pool);

/// Histogram of `qualities` between 0, below which elements are inverted, and 1, the ideal element; NaN is ignored.
[[nodiscard]] Histogram make_histogram(std::span<const double> qualities);

/// The worst `most` elements, worst first, ties by index. NaN is ignored.
[[nodiscard]] std::vector<RankedElement> worst_elements(std::span<const double> qualities, std::size_t most);

}  // namespace dmoscope
