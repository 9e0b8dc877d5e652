#pragma once
// Options that several subcommands share.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/common/judged_run.h"
#include "core/input/input_mesh.h"
#include "core/io/reading/io_context.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

/// Declares --surface.
void add_surface_option(CLI::App& subcommand, std::filesystem::path& surface);

/// Declares --materials.
void add_materials_option(CLI::App& subcommand, std::vector<std::string>& materials);

/// Loads the input, to slide on another surface if a file is given: see load_input() and slide_on().
[[nodiscard]] std::shared_ptr<const InputMesh> load_input_on(const std::filesystem::path& mesh, const std::filesystem::path& surface,
                                                             Need need, const IoContext& context,
                                                             std::span<const std::string> materials = {});

struct ReadingOptions {
  std::string geographic = "auto", thin = "auto";
  /// Sets them for reading. Throws UsageError.
  void tell(IoContext& reading) const;
};

/// Declares --geographic and --thin.
void add_reading_options(CLI::App& subcommand, ReadingOptions& options);

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
