#pragma once
// The --surface option: another mesh, on whose surface vertices slide.

#include <filesystem>
#include <memory>

#include "core/input/input_mesh.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

/// Declares --surface.
void add_surface_option(CLI::App& subcommand, std::filesystem::path& surface);

/// load_input, to slide on another surface where a file is given: see slide_on().
[[nodiscard]] std::shared_ptr<const InputMesh> load_input_on(const std::filesystem::path& mesh, const std::filesystem::path& surface,
                                                             Need need, const IoContext& context);

}  // namespace dmoscope::app
