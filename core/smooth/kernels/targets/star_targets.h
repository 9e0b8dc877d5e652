#pragma once
// Targets of the stars of a StarTable, laid out as its elements are.

#include <cstdint>
#include <span>
#include <vector>

#include "core/search/target_form.h"
#include "core/smooth/kernels/star_table.h"
#include "core/target/target_table.h"

namespace dmoscope {

class ThreadPool;

struct StarTargets {
  std::vector<std::uint32_t> first;  // by rank, counted in targets: a triangle has one, a quadrilateral those of the vertex's corner, of
                                     // the next, of the previous and of the opposite one
  std::vector<double> numbers;
};

/// Returns whether any targets in the plane are crossed: see TargetForm.
[[nodiscard]] bool has_crossed_targets(const TargetTable& targets, Index elements);
/// Appends the targets of one star. `others`: those of its shape, as vertices.
void append_star_targets(const TargetTable& targets, bool crossed, const Mesh& mesh, const Topology& topology, Index vertex,
                         const StarShape& shape, std::span<const Index> others, std::vector<double>& numbers);
/// Targets of a planar mesh. `crossed`: see has_crossed_targets(). Throws UsageError where 32 bits cannot count them.
[[nodiscard]] StarTargets build_star_targets(const TargetTable& targets, bool crossed, const Mesh& mesh, const Topology& topology,
                                             const StarTable& table, ThreadPool* pool);

}  // namespace dmoscope
