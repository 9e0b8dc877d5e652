#pragma once
// The options for the end of a run, shared by the subcommands that smooth.

#include "app/common/judged_run.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

struct GoalOptions {
  std::uint64_t iterations = 20;
  bool until_converged = false;
  ConvergenceLimits limits;
};

/// Declares --iterations, --until-converged, --patience and --max-iterations.
void add_goal_options(CLI::App& subcommand, GoalOptions& options);

[[nodiscard]] inline Goal goal_of(const GoalOptions& options) {
  Goal goal{options.iterations};
  if (options.until_converged) goal.until_converged = options.limits;
  return goal;
}

}  // namespace dmoscope::app
