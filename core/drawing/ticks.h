#pragma once
// Ticks of a plot's axes, and the points of a long series that are worth drawing. No drawing here.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dmoscope {

struct Tick {
  double value;
  std::string label;  // empty for a minor tick
};

/// Ticks at 1, 2 or 5 times a power of ten inside [lowest, highest], at most about `most` of them. All labels have the same number
/// of decimals. Empty when the range is empty or not finite.
[[nodiscard]] std::vector<Tick> linear_ticks(double lowest, double highest, int most);

/// Ticks at whole numbers only (steps of 1, 2, 5, 10, ...), at most about `most` of them.
[[nodiscard]] std::vector<Tick> integer_ticks(double lowest, double highest, int most);

/// Ticks at powers of ten inside [lowest, highest] (every k-th if there are more than `most`), with unlabelled ticks at 2..9 between them
/// if they are few; over less than two decades also labels at 2 and 5, and with fewer than two labels inside, as many as needed. Both
/// bounds must be > 0, else empty.
[[nodiscard]] std::vector<Tick> log_ticks(double lowest, double highest, int most);

/// Ticks of an axis that is linear in the logarithm of 1 + value / pivot, and so has 0: 0 and, from `pivot` on, as many of 1, 2 and 5 times
/// a power of ten as have room, at most about `most`. Empty if there would be fewer than three.
[[nodiscard]] std::vector<Tick> log_ticks_from_zero(double lowest, double highest, double pivot, int most);

struct PlotPoint {
  double x, y;
};
/// A part of a series without gaps.
using Stroke = std::vector<PlotPoint>;

/// Points that have to be drawn of a series over x in [lowest, highest], `columns` pixels wide: in each pixel column the first, smallest,
/// largest and last point, so that no peak is lost and a stroke has at most 4 points per column. A NaN (or infinite) y is a gap. One point
/// beyond either end is kept, so that lines reach the frame. x must ascend; x.size() == y.size().
[[nodiscard]] std::vector<Stroke> decimate(std::span<const double> x, std::span<const double> y, double lowest, double highest,
                                           std::size_t columns);

}  // namespace dmoscope
