#pragma once
// Structured grids of VTK's formats: points in rows, columns and layers, whose cells are not listed.

#include <array>
#include <cstddef>
#include <string>

#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Numbers of points along x, y and z; with a 1 among them the grid is flat.
struct VtkGridSize {
  std::array<std::size_t, 3> points{1, 1, 1};

  /// Reason why no mesh can be made of such a grid; empty if one can. `most`: greatest number of points.
  [[nodiscard]] std::string fault(std::size_t most) const;
  [[nodiscard]] std::size_t point_count() const noexcept { return points[0] * points[1] * points[2]; }
  /// Number of cells: quadrilaterals of a flat grid, hexahedra of others. These two functions require a grid without a fault.
  [[nodiscard]] std::size_t cell_count() const noexcept;
};

/// Adds the cells in VTK's order: along x first, then y, then z. The points, in that order as well, are those of the mesh from the first
/// on.
void add_structured_cells(Mesh& mesh, const SourceFile& source, const VtkGridSize& size);

}  // namespace dmoscope
