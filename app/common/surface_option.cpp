#include "app/common/surface_option.h"

#include <CLI/CLI.hpp>

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

}  // namespace dmoscope::app
