#pragma once
// A picture of a mesh coloured by quality, without a window.

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/progress.h"
#include "core/quality/metric.h"

namespace dmoscope::app {

struct PictureOptions {
  std::filesystem::path input;
  std::filesystem::path output;  // .png
  Metric metric = Metric::MeanRatio;
  int width = 1280, height = 800;  // pixels
  std::string colormap = "viridis";
  std::optional<std::pair<double, double>> range;  // of quality; none: 0 to 1
  bool transparent = false;
  bool wireframe = true;
  bool colour_bar = true;
  int supersample = 2;  // 1 to 8: drawn that much larger and averaged
};

/// Reads, draws, writes (all or nothing). Throws Error (bad input, no usable EGL, unwritable target) and Cancelled. Returns 0.
int render_picture(const PictureOptions& options, Progress& progress);

}  // namespace dmoscope::app
