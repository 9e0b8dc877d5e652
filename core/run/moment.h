#pragma once
// Moment: place of a run on its path.

#include <compare>
#include <cstdint>
#include <memory>

namespace dmoscope {

/// Whole iterations done, visits done of the next one, and edits (edit.h) done at this very place. So {3, 0, 0} is the end of the third
/// iteration, and {3, 0, 1} what the first edit there made of it.
struct Moment {
  std::uint64_t iteration = 0;
  std::uint64_t visits = 0;
  std::uint64_t edits = 0;
  friend auto operator<=>(const Moment&, const Moment&) = default;
  /// Returns whether this is the end of an iteration (or the input): those moments the history records and keeps.
  [[nodiscard]] bool is_iteration_end() const noexcept { return visits == 0 && edits == 0; }
};

class Run;

/// State of a run: findings about it hold wherever this is equal.
struct StandingRun {
  std::weak_ptr<const Run> run;
  std::uint64_t path = 0;  // see Run::path
  Moment moment{};
  [[nodiscard]] bool is_of(const StandingRun& other) const { return !run.expired() && run.lock() == other.run.lock(); }
  friend bool operator==(const StandingRun& a, const StandingRun& b) { return a.is_of(b) && a.path == b.path && a.moment == b.moment; }
};

}  // namespace dmoscope
