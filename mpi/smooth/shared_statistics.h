#pragma once
// Statistics of a mesh that many ranks have: the very bits that one process finds.

#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/quality/quality.h"
#include "mpi/mesh/share.h"

namespace dmoscope {

/// Sums in floating point depend on their order, so all are added in the order of the mesh's elements, in the stretches of core's Tally:
/// each rank adds stretches of the whole mesh, for which the others send it the qualities of their elements.
class SharedStatistics {
 public:
  /// All ranks together. The share must outlive it.
  SharedStatistics(const World& world, const Share& share);
  /// See compute_statistics(); `immovable`: of the share. All ranks together.
  [[nodiscard]] Statistics of(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                              std::span<const Index> immovable, ThreadPool* pool) const;
  /// The sum of values by element of the share, of which NaN are left out, and how many are not: as core adds qualities up.
  struct Sum {
    double sum = 0.0;
    std::uint64_t count = 0;
  };
  [[nodiscard]] Sum sum(std::span<const double> values) const;

 private:
  [[nodiscard]] Sum sum_of_mine() const;

  World world_;
  const Share* share_;
  Ranges stretches_;       // elements of the whole mesh, in whole stretches
  std::vector<Index> to_;  // elements that are counted here, by the rank that adds them up
  std::vector<std::uint64_t> to_offsets_;
  Ranges groups_;                                       // of stretches: which rank adds up their sums
  std::vector<std::uint64_t> sums_to_, sums_from_;      // offsets by rank of the sums of stretches that are sent and that come
  Parts<std::uint32_t> places_;                         // where in the rank's stretches come those that others send
  mutable std::vector<double> mine_, came_, in_order_;  // kept: fresh memory costs as much as the sums
};

}  // namespace dmoscope
