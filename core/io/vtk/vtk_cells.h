#pragma once
// Cells of a VTK legacy file, in the layout of versions up to 4.2 and in that of version 5.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/vtk/vtk_values.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// A list of cells: the corners of all of them, and where each stands in the file.
struct VtkCells {
  std::vector<Index> offsets{0};
  std::vector<Index> corners;
  std::vector<std::size_t> places;  // of each cell, a byte offset
  [[nodiscard]] std::size_t size() const noexcept { return offsets.size() - 1; }
  /// The corners of a cell.
  [[nodiscard]] std::span<const Index> of(std::size_t cell) const noexcept {
    return {corners.data() + offsets[cell], corners.data() + offsets[cell + 1]};
  }
};

/// Reads what follows the word `keyword` (CELLS, POLYGONS, LINES, ...). Corners are checked to be below `points`.
/// Throws InputError, also when the sizes that the file declares do not agree with what it holds.
[[nodiscard]] VtkCells read_vtk_cells(VtkValues& values, const std::string& keyword, std::size_t points);

/// What stands for a kind of element where a cell is none: vertices, or a chain of lines; and where it is nothing at all.
inline constexpr std::uint8_t kNoKind = 0xff, kVertexCell = 0xfe, kLineCell = 0xfd;

/// The role of the groups that cells of fewer dimensions become.
inline constexpr std::string_view kVtkCells = "cells";

/// What a cell is to us.
struct VtkElement {
  std::uint8_t kind = kNoKind;  // an ElementKind, or one of the above: a cell of fewer dimensions than two, which is not smoothed
  std::string fault;            // not empty: why the cell cannot be read
  bool fault_of_type = false;   // the fault is the type itself, not the number of corners
};
/// The element that a cell of VTK's type `type` with `corners` is. `corners` are brought into our order: from pixels and voxels to
/// quadrilaterals and hexahedra, and see vtk_order.h.
[[nodiscard]] VtkElement element_of_vtk_cell(std::int64_t type, std::span<Index> corners);

/// Makes elements of those cells that have the highest dimension of all; kinds: VtkElement::kind of each cell. The others, and the
/// `vertices` and `lines` of POLYDATA (null: none), become a group of vertices, one of edges and one of faces. Returns the cells that
/// became elements.
[[nodiscard]] std::vector<std::size_t> add_vtk_elements(Mesh& mesh, SourceFile& source, const VtkCells& cells,
                                                        std::span<const std::uint8_t> kinds, const VtkCells* vertices = nullptr,
                                                        const VtkCells* lines = nullptr);

/// Keeps of a field these rows alone; the source says what other formats will lack.
void keep_rows(Field& field, std::span<const std::size_t> rows, SourceFile& source);

/// VTK's number for a kind of element.
[[nodiscard]] int vtk_cell_type(ElementKind kind) noexcept;

}  // namespace dmoscope
