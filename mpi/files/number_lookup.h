#pragma once
// Which thing has which number, in a file whose parts many ranks have read.

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/world/world.h"

namespace dmoscope {

/// What a rank learns of the things that it asked for by number.
struct NumberLookup {
  /// The first thing of each asked number; kNone where no thing has it.
  std::vector<std::uint64_t> found;
  std::uint64_t twice = kNone;  // the least thing that has the number of one before it, on any rank; kNone: there is none
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
};

/// `numbers`: of this rank's things, which are numbers first, first + 1, ... of all; `asked`: wanted numbers. All ranks together.
[[nodiscard]] NumberLookup look_up_numbers(const World& world, std::span<const std::int64_t> numbers, std::uint64_t first,
                                           std::span<const std::int64_t> asked);

}  // namespace dmoscope
