#include "app/common/goal_options.h"

#include <CLI/CLI.hpp>

#include "app/common/option_checks.h"

namespace dmoscope::app {

void add_goal_options(CLI::App& subcommand, GoalOptions& options) {
  constexpr std::uint64_t kMostIterations = 1'000'000'000;
  auto* iterations = subcommand.add_option("--iterations", options.iterations, "How many iterations")
                         ->transform(whole_number(0, kMostIterations))
                         ->type_name("N")
                         ->capture_default_str();
  auto* until =
      subcommand.add_flag("--until-converged", options.until_converged, "Go on until no vertex moves or the minimum no longer rises");
  until->excludes(iterations);
  subcommand.add_option("--patience", options.limits.patience, "Iterations without a rise of 1e-6 that count as converged")
      ->needs(until)
      ->transform(whole_number(1, kMostIterations))
      ->type_name("N")
      ->capture_default_str();
  subcommand.add_option("--max-iterations", options.limits.max_iterations, "Stop there with exit code 1 when not converged")
      ->needs(until)
      ->transform(whole_number(0, kMostIterations))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace dmoscope::app
