#pragma once
// Common parts of pictures of planar and of volume meshes. Only for their sources.

#include <span>
#include <vector>

#include "app/window/picture.h"
#include "render/screenshot.h"

namespace dmoscope::app {

/// Qualities of a mesh's elements.
struct JudgedElements {
  std::vector<float> quality;  // NaN: not defined
  std::vector<std::uint8_t> inverted;
  std::size_t inverted_count;
  double minimum;  // infinity if no quality is defined
};

/// Judges the mesh with its vertices at `positions`. Throws UsageError for a metric that is not defined for its elements, and Cancelled.
[[nodiscard]] JudgedElements judge(const InputMesh& input, std::span<const Vec3> positions, Metric metric, const Progress& progress);

[[nodiscard]] render::Style style_of(const PictureLook& look, const JudgedElements& judged);
[[nodiscard]] render::Shot shot_of(const InputMesh& input, const JudgedElements& judged, const PictureLook& look);

}  // namespace dmoscope::app
