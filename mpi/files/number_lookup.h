#pragma once
// Lookup of things by their numbers, in a file whose parts many ranks have read.

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/world/world.h"

namespace dmoscope {

/// Answers about the things that a rank asked for by number.
struct NumberLookup {
  /// The first thing of each asked number; kNone if no thing has it.
  std::vector<std::uint64_t> found;
  std::uint64_t twice = kNone;  // the least thing whose number an earlier one has, on any rank; kNone: there is none
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
};

/// Looks numbers up. `numbers`: of this rank's things, which are things first, first + 1, ... of all; `asked`: wanted numbers. To be called
/// by all ranks together.
[[nodiscard]] NumberLookup look_up_numbers(const World& world, std::span<const std::int64_t> numbers, std::uint64_t first,
                                           std::span<const std::int64_t> asked);

}  // namespace dmoscope
