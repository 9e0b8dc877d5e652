#pragma once
// Options for an input beyond its file: --surface, another mesh, on whose surface vertices slide; --materials, cell data that name
// materials.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"

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

}  // namespace dmoscope::app
