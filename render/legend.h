#pragma once
// The colour bar of a picture. No OpenGL.

#include <string>
#include <vector>

#include "render/image.h"
#include "render/screenshot.h"
#include "render/style.h"

namespace dmoscope::render {

/// Height in pixels that a legend takes at the lower border of a picture.
[[nodiscard]] int legend_height(float scale);

/// Draws the legend into the lowest legend_height(scale) rows of `image`. Returns a note when there is no font, otherwise "".
[[nodiscard]] std::string draw_legend(Image& image, const Legend& legend, const Style& style, float scale);

/// About `wanted` round numbers (1, 2, 2.5 or 5 times a power of ten apart) within [low, high], for an axis.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int wanted);

}  // namespace dmoscope::render
