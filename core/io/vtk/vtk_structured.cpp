#include "core/io/vtk/vtk_structured.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/io/format.h"

namespace dmoscope {

std::string VtkGridSize::fault(std::size_t most) const {
  std::size_t count = 1;
  for (const std::size_t n : points) {
    if (n == 0) return "a grid without points";
    if (n > most / count)
      return fmt::format("a grid of {} x {} x {} points: more than its file can be about", points[0], points[1], points[2]);
    count *= n;
  }
  if (std::ranges::count(points, std::size_t{1}) > 1) {
    return fmt::format("a grid of {} x {} x {} points has no cells of two or three dimensions", points[0], points[1], points[2]);
  }
  return {};
}

std::size_t VtkGridSize::cell_count() const noexcept {
  std::size_t count = 1;
  for (const std::size_t n : points) count *= std::max<std::size_t>(n - 1, 1);
  return count;
}

void add_structured_cells(Mesh& mesh, const SourceFile& source, const VtkGridSize& size) {
  const std::array<std::size_t, 3> step{1, size.points[0], size.points[0] * size.points[1]};  // strides of points along x, y, z
  std::array<std::size_t, 3> axes{};                                                          // axes along which there are cells
  std::size_t used = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size.points[axis] > 1) axes[used++] = axis;
  }
  const std::array<std::size_t, 4> face{0, step[axes[0]], step[axes[0]] + step[axes[1]], step[axes[1]]};
  const std::size_t up = used == 3 ? step[axes[2]] : 0;
  const auto cells = [&](std::size_t axis) { return std::max<std::size_t>(size.points[axis] - 1, 1); };
  mesh.elements.reserve(size.cell_count(), size.cell_count() * (used == 3 ? 8 : 4));
  for (std::size_t k = 0; k < cells(2); ++k) {
    for (std::size_t j = 0; j < cells(1); ++j) {
      for (std::size_t i = 0; i < cells(0); ++i) {
        const std::size_t first = i * step[0] + j * step[1] + k * step[2];
        std::array<Index, 8> corners{};
        for (std::size_t c = 0; c < 4; ++c) {
          corners[c] = static_cast<Index>(first + face[c]);
          corners[c + 4] = static_cast<Index>(first + face[c] + up);
        }
        const auto kind = used == 3 ? ElementKind::Hexahedron : ElementKind::Quadrilateral;
        add_element(mesh, kind, std::span<const Index>(corners.data(), info(kind).corners), source);
      }
    }
  }
}

}  // namespace dmoscope
