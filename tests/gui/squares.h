#pragma once
// A mesh file to open in a window, small enough to know every vertex.

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace dmoscope::app {

/// Text of an OFF file: n x n unit squares of two triangles each, vertex x + (n + 1) y at (x, y); but `moved` stands at `place` ("x y z").
[[nodiscard]] inline std::string squares_with(int n, int moved, std::string_view place) {
  const int row = n + 1;
  std::string text = fmt::format("OFF\n{} {} 0\n", row * row, 2 * n * n);
  for (int v = 0; v < row * row; ++v) text += v == moved ? fmt::format("{}\n", place) : fmt::format("{} {} 0\n", v % row, v / row);
  for (int cell = 0; cell < n * n; ++cell) {
    const int a = cell % n + row * (cell / n);
    text += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, a + 1, a + row, a + 1, a + row + 1, a + row);
  }
  return text;
}

}  // namespace dmoscope::app
