#pragma once
// Sweep of the next visits: told by the records of the iterations before them alone, so that an iteration done again has the same bits.

#include <cstdint>
#include <optional>
#include <span>

#include "core/run/history.h"
#include "core/smooth/smoother.h"

namespace dmoscope {

/// Numbers and lengths of the attempts to untangle, see Untangling. Counted from the input or from the last iteration that left fewer
/// inverted elements than it found.
struct UntanglingPlan {
  static constexpr std::uint64_t kRepairs = 5;  // iterations at the very first, as long as each leaves fewer inverted elements
  static constexpr std::uint64_t kAttempt = 5;  // iterations of an attempt, after one in which only sound moves may untangle
  static constexpr std::uint64_t kCycle = 25;   // iterations from one attempt to the next; in between sound elements recover
  static constexpr std::uint64_t kEnd = 50;     // no more attempts from this iteration on
};

/// Phase that raises a mean.
struct MeanPhase {
  std::optional<std::uint64_t> since{};  // see Run::mean_since()
  MeanKind kind = MeanKind::Harmonic;
};

/// The sweep of the iteration after records[iteration], which must exist. `strays`: whether the input has any, see InputMesh: if so, the
/// run begins with repairs.
[[nodiscard]] Sweep sweep_after(std::span<const IterationRecord> records, std::uint64_t iteration, const MeanPhase& mean, bool strays);

/// Whether vertices around inverted elements are then moved together instead of one by one: at the very first, after the repairs of strays,
/// and once after the last attempt.
[[nodiscard]] bool untangles_jointly(std::span<const IterationRecord> records, std::uint64_t iteration, bool strays);

/// Iterations since the number of inverted elements last fell, at the end of `iteration`: at most UntanglingPlan::kEnd.
[[nodiscard]] std::uint64_t iterations_since_untangled(std::span<const IterationRecord> records, std::uint64_t iteration);

}  // namespace dmoscope
