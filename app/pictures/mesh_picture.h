#pragma once
// Pictures of meshes for pages, if this program and this machine can draw.

#include <span>
#include <string>

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

}  // namespace dmoscope::app
