#pragma once
// Candidates of a level that a flat map shows.

#include <array>
#include <optional>

namespace dmoscope::ui {

/// All candidates of a grid in the plane, or those of one slice of a grid in space. The map's columns and rows count along the other two
/// axes in their order, from the left and from below.
struct GridSlice {
  int points = 0;           // points of the grid per axis
  std::optional<int> axis;  // axis at right angles to the slice (0 x, 1 y, 2 z); none: the grid is flat
  int number = 0;           // number of the slice along it, from 0

  /// Index of the candidate at a place of the map.
  [[nodiscard]] int index(int column, int row) const {
    const int n = points;
    if (!axis) return column * n + row;
    if (*axis == 0) return (number * n + column) * n + row;
    if (*axis == 1) return (column * n + number) * n + row;
    return (column * n + row) * n + number;
  }
  /// Column and row of a candidate; none if it belongs to another slice.
  [[nodiscard]] std::optional<std::array<int, 2>> place(int candidate) const {
    const int n = points;
    if (!axis) return std::array{candidate / n, candidate % n};
    const std::array<int, 3> at{candidate / (n * n), candidate / n % n, candidate % n};
    if (at[static_cast<std::size_t>(*axis)] != number) return std::nullopt;
    return std::array{*axis == 0 ? at[1] : at[0], *axis == 2 ? at[1] : at[2]};
  }
  /// Place of any candidate along the axis of the slice.
  [[nodiscard]] int along(int candidate) const {
    const int n = points;
    if (!axis) return 0;
    return *axis == 0 ? candidate / (n * n) : *axis == 1 ? candidate / n % n : candidate % n;
  }
};

}  // namespace dmoscope::ui
