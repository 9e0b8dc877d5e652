#pragma once
// Pictures for pages and files: of meshes, if this program and this machine can draw; and plots.

#include <filesystem>
#include <span>
#include <string>

#include "core/drawing/drawing.h"
#include "core/input/input_mesh.h"

namespace dmoscope::app {

struct MeshPicture {
  std::string png;      // a PNG file's bytes; empty without a picture
  std::string why_not;  // the reason if there is no picture
};

/// The colours of these pictures from the low end to 1, as the CSS of a background; empty if there are no pictures.
[[nodiscard]] std::string quality_gradient();

/// Draws the mesh with its vertices at `positions`, coloured by `metric` from `low` to 1, inverted elements magenta, on no background, 800
/// x 600 pixels. Throws UsageError if the metric is not defined for the mesh, Cancelled.
[[nodiscard]] MeshPicture picture_of_mesh(const InputMesh& input, std::span<const Vec3> positions, Metric metric, const Progress& progress,
                                          double low = 0.0);

/// Throws UsageError if write_plot() does not know this kind of file, OutputError if the file cannot be written.
void require_plot_target(const std::filesystem::path& path);

/// Returns the bytes that write_plot() writes.
[[nodiscard]] std::string plot_bytes(const std::filesystem::path& path, const Drawing& drawing);

/// Writes an .svg, or a .png if the program was built with its window; all or nothing. Throws OutputError.
void write_plot(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace dmoscope::app
