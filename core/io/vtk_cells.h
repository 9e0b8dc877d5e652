#pragma once
// Cells of a VTK legacy file, in the layout of versions up to 4.2 and in that of version 5.

#include <optional>
#include <span>
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

/// What a cell is to us.
struct VtkElement {
  std::optional<ElementKind> kind;  // empty: a cell of fewer dimensions than two, which is not smoothed
  std::string fault;                // not empty: why the cell cannot be read
  bool fault_of_type = false;       // the fault is the type itself, not the number of corners
};
/// The element that a cell of VTK's type `type` with `corners` is. `corners` are brought into our order: from pixels and voxels to
/// quadrilaterals and hexahedra, and see vtk_order.h.
[[nodiscard]] VtkElement element_of_vtk_cell(std::int64_t type, std::span<Index> corners);

/// What stands for a kind of element where a cell is none.
inline constexpr std::uint8_t kNoKind = 0xff;

/// Makes elements of those cells that have the highest dimension of all; kinds: an ElementKind or kNoKind for each cell. The others, and
/// `low` cells besides that are not among them, are named in the source. Returns the cells that became elements.
[[nodiscard]] std::vector<std::size_t> add_vtk_elements(Mesh& mesh, SourceFile& source, const VtkCells& cells,
                                                        std::span<const std::uint8_t> kinds, std::size_t low);

/// Keeps of a field these rows alone.
void keep_rows(Field& field, std::span<const std::size_t> rows);

/// VTK's number for a kind of element.
[[nodiscard]] int vtk_cell_type(ElementKind kind) noexcept;

}  // namespace dmoscope
