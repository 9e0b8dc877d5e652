#pragma once
// Cells of a VTK legacy file, in the layout of versions up to 4.2 and in that of version 5.

#include <optional>
#include <string>
#include <vector>

#include "core/io/vtk_values.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// A list of cells: the corners of all of them, and where each stands in the file.
struct VtkCells {
  std::vector<Index> offsets{0};
  std::vector<Index> corners;
  std::vector<std::size_t> places;  // of each cell, a byte offset
  [[nodiscard]] std::size_t size() const noexcept { return offsets.size() - 1; }
};

/// Reads what follows the word `keyword` (CELLS, POLYGONS, LINES, ...). Corners are checked to be below `points`.
/// Throws InputError, also when the sizes that the file declares do not agree with what it holds.
[[nodiscard]] VtkCells read_vtk_cells(VtkValues& values, const std::string& keyword, std::size_t points);

/// The element that a cell of VTK's type `type` with `corners` is; empty for cells of fewer dimensions, which are not smoothed.
/// `corners` are reordered from pixels and voxels to quadrilaterals and hexahedra. Throws InputError through `in`: at `type_place` for
/// types that the program does not know, at `cell_place` for a number of corners that the type does not have.
[[nodiscard]] std::optional<ElementKind> element_of_vtk_cell(const MixedInput& in, std::int64_t type, std::vector<Index>& corners,
                                                             std::size_t cell_place, std::size_t type_place);

/// VTK's number for a kind of element.
[[nodiscard]] int vtk_cell_type(ElementKind kind) noexcept;

}  // namespace dmoscope
