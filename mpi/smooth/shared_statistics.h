#pragma once
// Statistics of a mesh that ranks share, with the bits that one process finds.

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/quality/quality.h"
#include "mpi/mesh/share.h"
#include "mpi/world/world.h"

namespace dmoscope {

// Order statistics of values that ranks share.

/// Returns the values of these ranks, from 0, among all values. `here`: this rank's, ascending, none of them NaN; each of `ranks` is below
/// the number of all. To be called by all ranks of the world together.
[[nodiscard]] std::vector<double> values_of_ranks(const World& world, std::span<const double> here, std::span<const std::uint64_t> ranks);

/// Adds in the order of the mesh's elements, in the stretches of core's Tally, since floating-point sums depend on their order: each rank
/// adds stretches of the whole mesh, for which the others send it the qualities of their elements.
class SharedStatistics {
 public:
  /// Plans the exchange, all ranks together. The share must outlive it.
  SharedStatistics(const World& world, const Share& share);
  /// Computes the statistics: see compute_statistics(). `immovable`: of the share. To be called by all ranks together.
  [[nodiscard]] Statistics of(const QualityContext& context, std::span<const Vec3> positions, Metric metric,
                              std::span<const Index> immovable, ThreadPool* pool) const;
  /// Sum of the values that are not NaN, and their number, with core's order of addition.
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
  Ranges groups_;                                       // ranges of stretches: the rank that adds up their sums
  std::vector<std::uint64_t> sums_to_, sums_from_;      // offsets by rank of the sums of stretches that are sent and received
  Parts<std::uint32_t> places_;                         // places in the rank's stretches of values that others send
  mutable std::vector<double> mine_, came_, in_order_;  // kept: fresh memory costs as much as the sums
};

}  // namespace dmoscope
