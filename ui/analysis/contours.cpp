#include "ui/analysis/contours.h"

#include <array>
#include <cmath>

namespace dmoscope::ui {
namespace {

/// One cell: its corners counter-clockwise from the lower left one, and their values relative to the level.
struct Cell {
  std::array<Vec2<double>, 4> corner;
  std::array<double, 4> above;  // value - level

  /// Point where side `k`, from corner k to the next, crosses the level.
  [[nodiscard]] Vec2<double> crossing(std::size_t k) const {
    const std::size_t next = (k + 1) % 4;
    const double t = above[k] / (above[k] - above[next]);
    return {corner[k].x + t * (corner[next].x - corner[k].x), corner[k].y + t * (corner[next].y - corner[k].y)};
  }
};

void march(const Cell& cell, std::vector<ContourPiece>& pieces) {
  std::array<std::size_t, 4> sides{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if ((cell.above[k] > 0.0) != (cell.above[(k + 1) % 4] > 0.0)) sides[count++] = k;
  }
  if (count == 2) pieces.push_back({cell.crossing(sides[0]), cell.crossing(sides[1])});
  if (count < 4) return;
  // This is a saddle: corners 0 and 2 are on the same side of the level. The two corners that the middle is unlike are cut off, each by a
  // piece of its own.
  const double middle = (cell.above[0] + cell.above[1] + cell.above[2] + cell.above[3]) / 4.0;
  const bool even_together = (middle > 0.0) == (cell.above[0] > 0.0);
  for (const std::size_t cut_off : even_together ? std::array<std::size_t, 2>{1, 3} : std::array<std::size_t, 2>{0, 2})
    pieces.push_back({cell.crossing((cut_off + 3) % 4), cell.crossing(cut_off)});
}

}  // namespace

std::vector<ContourPiece> contour(std::span<const float> values, int columns, int rows, double level) {
  std::vector<ContourPiece> pieces;
  constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      Cell cell{};
      bool defined = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const int x = column + kCorners[k][0], y = row + kCorners[k][1];
        const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
        cell.corner[k] = {static_cast<double>(x), static_cast<double>(y)};
        cell.above[k] = static_cast<double>(values[at]) - level;
        defined = defined && !std::isnan(values[at]);
      }
      if (defined) march(cell, pieces);
    }
  }
  return pieces;
}

}  // namespace dmoscope::ui
