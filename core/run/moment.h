#pragma once
// Where a run stands.

#include <compare>
#include <cstdint>

namespace dmoscope {

/// Whole iterations done, visits done of the next one, and edits (edit.h) done at this very place. So {3, 0, 0} is the end of the third
/// iteration, and {3, 0, 1} what the first edit there made of it.
struct Moment {
  std::uint64_t iteration = 0;
  std::uint64_t visits = 0;
  std::uint64_t edits = 0;
  friend auto operator<=>(const Moment&, const Moment&) = default;
  /// Whether it is the end of an iteration (or the input), which is what the history records and keeps.
  [[nodiscard]] bool is_iteration_end() const noexcept { return visits == 0 && edits == 0; }
};

}  // namespace dmoscope
