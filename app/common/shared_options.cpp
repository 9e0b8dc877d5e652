#include "app/common/shared_options.h"

#include <CLI/CLI.hpp>

#include "app/common/option_checks.h"
#include "core/mesh/geographic.h"
#include "core/mesh/thin.h"
#include "core/reference/slide_on.h"

namespace dmoscope::app {

void add_surface_option(CLI::App& subcommand, std::filesystem::path& surface) {
  subcommand
      .add_option("--surface", surface,
                  "Another mesh, of a curved surface or of a volume: vertices slide on its surface and along its feature edges, instead of "
                  "those of the mesh itself, and elements of a curved surface that look away from it are inverted")
      ->type_name("FILE");
}

void add_materials_option(CLI::App& subcommand, std::vector<std::string>& materials) {
  subcommand
      .add_option("--materials", materials,
                  "Cell data that name materials whatever they are called: vertices between their values are on interfaces (repeatable)")
      ->type_name("FIELD")
      ->allow_extra_args(false);
}

std::shared_ptr<const InputMesh> load_input_on(const std::filesystem::path& mesh, const std::filesystem::path& surface, Need need,
                                               const IoContext& context, std::span<const std::string> materials) {
  if (surface.empty()) return load_input(mesh, need, context, materials);
  IoContext of_all = context;  // both meshes' boundaries are those of all cells
  if (of_all.thin == Thin::Auto) of_all.thin = Thin::Off;
  const auto input = load_input(mesh, need, of_all, materials);
  of_all.thin = Thin::Off;
  return slide_on(*input, load_input(surface, Need::QualityOnly, of_all));
}

void ReadingOptions::tell(IoContext& reading) const {
  reading.geographic = parse_geographic(geographic);
  reading.thin = parse_thin(thin);
}

void add_reading_options(CLI::App& subcommand, ReadingOptions& options) {
  subcommand
      .add_option(
          "--geographic", options.geographic,
          "Whether x and y are longitude and latitude in degrees, so that elements are judged on the Earth: on, off, or auto: where "
          "the title or the name of a fort.14 or .2dm says so")
      ->type_name("on|off|auto")
      ->capture_default_str();
  subcommand
      .add_option("--thin", options.thin,
                  "Whether a mesh of hexahedra and wedges is one cell thick, so that it is taken for the 2-D mesh of its front, which the "
                  "back follows: on, off, or auto: where it is")
      ->type_name("on|off|auto")
      ->capture_default_str();
}

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
