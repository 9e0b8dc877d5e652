#pragma once
// A picture of a mesh for a page, where this program and this machine can make one.

#include <span>
#include <string>

#include "core/input/input_mesh.h"

namespace dmoscope::app {

struct MeshPicture {
  std::string png;      // a PNG file's bytes; empty: there is none
  std::string why_not;  // then
};

/// The colours of these pictures from the low end to 1, as the CSS of a background; empty where there are no pictures.
[[nodiscard]] std::string quality_gradient();

/// The mesh with its vertices at `positions`, coloured by `metric` from `low` to 1, inverted elements magenta, on no background, 800 x
/// 600 pixels. Throws UsageError when the metric is not defined for the mesh, Cancelled.
[[nodiscard]] MeshPicture picture_of_mesh(const InputMesh& input, std::span<const Vec3> positions, Metric metric, const Progress& progress,
                                          double low = 0.0);

}  // namespace dmoscope::app
