#pragma once
// What a run of iterations that is under way is after.

#include <cstdint>
#include <optional>

namespace dmoscope {

/// Of Run::iterate and Run::until_converged, while they are at work.
struct Pursuit {
  std::uint64_t from = 0, last = 0;  // it began at the end of iteration `from`, and ends at the latest with that of `last`
  bool until_converged = false;
  /// Of until_converged: it ends after so many more iterations without a gain; none while it does not end by that.
  std::optional<std::uint64_t> patience_left{};
};

}  // namespace dmoscope
