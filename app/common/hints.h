#pragma once
// Hints after a run: the option, their time limits, and that they change nothing.

#include <algorithm>
#include <cstdint>
#include <exception>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/run/hints.h"

namespace dmoscope::app {

/// On: within a tenth of the run's time. Full: without a time limit.
enum class Hints : std::uint8_t { On, Full, Off };
/// Parses the option's word. Throws UsageError.
[[nodiscard]] Hints parse_hints(std::string_view word);

[[nodiscard]] inline HintBudget budget_of(Hints hints, double run_seconds) {
  return hints == Hints::On ? HintBudget::of_run(run_seconds) : HintBudget();
}

/// Time budget, from now on, for hints together with a trial of a change that would free the minimum: a fifth of the run's time.
[[nodiscard]] inline HintBudget trial_budget_of(Hints hints, double run_seconds) {
  constexpr double kLeast = 0.1;  // seconds, too short to be noticed
  return hints == Hints::On ? HintBudget(std::max(kLeast, 0.2 * run_seconds)) : HintBudget();
}

/// Does optional work after the result is complete. Errors do not affect the result: `warn` is told.
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
