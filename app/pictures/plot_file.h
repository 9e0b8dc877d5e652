#pragma once
// Plots as files.

#include <filesystem>
#include <string>

#include "core/drawing/drawing.h"

namespace dmoscope::app {

/// Throws UsageError when write_plot() could not write this kind of file, OutputError when it could not write there.
void require_plot_target(const std::filesystem::path& path);

/// The bytes of such a file.
[[nodiscard]] std::string plot_bytes(const std::filesystem::path& path, const Drawing& drawing);

/// An .svg, or a .png where the program was built with its window; all or nothing. Throws OutputError.
void write_plot(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace dmoscope::app
