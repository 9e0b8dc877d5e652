#pragma once
// Lines of equal value in a field of samples.

#include <span>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope::ui {

/// A piece of a contour; in samples: column and row of its ends.
struct ContourPiece {
  Vec2<double> from, to;
};

/// Where the field takes `level`, by marching squares with linear interpolation; values[row * columns + column]. A cell of four samples is
/// left out when one of them is NaN; of a saddle the mean of the four decides which corners belong together.
[[nodiscard]] std::vector<ContourPiece> contour(std::span<const float> values, int columns, int rows, double level);

}  // namespace dmoscope::ui
