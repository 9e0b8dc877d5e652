#pragma once
// Hints after a run: how they are asked for, how long they may take, and that they change nothing.

#include <algorithm>
#include <cstdint>
#include <exception>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/run/hints.h"

namespace dmoscope::app {

/// On: for a tenth of the run's time. Full: as long as it takes.
enum class Hints : std::uint8_t { On, Full, Off };
/// Throws UsageError.
[[nodiscard]] Hints parse_hints(std::string_view word);

[[nodiscard]] inline HintBudget budget_of(Hints hints, double run_seconds) {
  return hints == Hints::On ? HintBudget::of_run(run_seconds) : HintBudget();
}

/// Time budget, from now on, for hints together with a trial of what would free the minimum: a fifth of the run's time.
[[nodiscard]] inline HintBudget trial_budget_of(Hints hints, double run_seconds) {
  constexpr double kLeast = 0.1;  // seconds, which nobody notices
  return hints == Hints::On ? HintBudget(std::max(kLeast, 0.2 * run_seconds)) : HintBudget();
}

/// Does what nobody waits for. What was asked for is done by then, and stays done whatever comes of this: `warn` is told.
template <class Look, class Warn>
void look_afterwards(std::string_view what, const Look& look, const Warn& warn) {
  try {
    look();
  } catch (const Cancelled&) {
  } catch (const std::exception& error) {
    warn(fmt::format("{} is not known: {}", what, error.what()));
  }
}

}  // namespace dmoscope::app
