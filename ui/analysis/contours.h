#pragma once
// Lines of equal value in a field of samples.

#include <span>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope::ui {

/// A piece of a contour: column and row of its ends, in samples.
struct ContourPiece {
  Vec2<double> from, to;
};

/// Pieces of the line on which the field is `level`, by marching squares with linear interpolation; values[row * columns + column]. A cell
/// of four samples is left out when one of them is NaN; in a saddle the mean of the four decides which corners belong together.
[[nodiscard]] std::vector<ContourPiece> contour(std::span<const float> values, int columns, int rows, double level);

}  // namespace dmoscope::ui
