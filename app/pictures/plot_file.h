#pragma once
// Plots as files.

#include <filesystem>
#include <string>

#include "core/drawing/drawing.h"

namespace dmoscope::app {

/// Throws UsageError if write_plot() does not know this kind of file, OutputError if the file cannot be written.
void require_plot_target(const std::filesystem::path& path);

/// Returns the bytes that write_plot() writes.
[[nodiscard]] std::string plot_bytes(const std::filesystem::path& path, const Drawing& drawing);

/// Writes an .svg, or a .png if the program was built with its window; all or nothing. Throws OutputError.
void write_plot(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace dmoscope::app
