#pragma once
// Structured grids of VTK's files: points in rows, columns and layers, whose cells nobody lists.

#include <array>
#include <cstddef>
#include <string>

#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// How many points there are along x, y and z; where it is 1, the grid is flat.
struct VtkGridSize {
  std::array<std::size_t, 3> points{1, 1, 1};

  /// Why no mesh can be made of such a grid; empty if one can. `most`: points that may be.
  [[nodiscard]] std::string fault(std::size_t most) const;
  [[nodiscard]] std::size_t point_count() const noexcept { return points[0] * points[1] * points[2]; }
  /// Quadrilaterals of a flat grid, hexahedra of others. Call these two only where there is no fault.
  [[nodiscard]] std::size_t cell_count() const noexcept;
};

/// Adds the cells in VTK's order: along x first, then y, then z. The points, in that order as well, are the mesh's from the first on.
void add_structured_cells(Mesh& mesh, const SourceFile& source, const VtkGridSize& size);

}  // namespace dmoscope
