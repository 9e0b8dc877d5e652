#pragma once
// Cells of a VTK legacy file, in the layouts of versions up to 4.2 and of version 5.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/format.h"
#include "core/io/reading/source_file.h"
#include "core/io/vtk/vtk.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// A list of cells: the corners of all of them, and the place of each in the file.
struct VtkCells {
  std::vector<Index> offsets{0};
  std::vector<Index> corners;
  std::vector<std::size_t> places;  // byte offset of each cell
  [[nodiscard]] std::size_t size() const noexcept { return offsets.size() - 1; }
  /// The corners of a cell.
  [[nodiscard]] std::span<const Index> of(std::size_t cell) const noexcept {
    return {corners.data() + offsets[cell], corners.data() + offsets[cell + 1]};
  }
};

/// Reads the cells behind the word `keyword` (CELLS, POLYGONS, LINES, ...). Corners are checked to be below `points`. Throws InputError,
/// also if the declared sizes do not agree with the contents.
[[nodiscard]] VtkCells read_vtk_cells(VtkValues& values, const std::string& keyword, std::size_t points);

/// Values in place of a kind of element for cells that are none: nothing, vertices, or a chain of lines.
inline constexpr std::uint8_t kNoKind = 0xff, kVertexCell = 0xfe, kLineCell = 0xfd;

/// Role of the groups made of cells of fewer dimensions.
inline constexpr std::string_view kVtkCells = "cells";

/// Meaning of a cell for the mesh.
struct VtkElement {
  std::uint8_t kind = kNoKind;  // an ElementKind, or one of the above: a cell of fewer dimensions than two, which is not smoothed
  std::string fault;            // reason why the cell cannot be read; empty: it can
  bool fault_of_type = false;   // whether the type itself is the fault, not the number of corners
};
/// The element that a cell of VTK's type `type` with `corners` is. Reorders `corners`: from pixels and voxels to quadrilaterals and
/// hexahedra, and exchange_vtk_order().
[[nodiscard]] VtkElement element_of_vtk_cell(std::int64_t type, std::span<Index> corners);

/// Makes elements of the cells of the highest dimension; kinds: VtkElement::kind of each cell. The others, and the `vertices` and `lines`
/// of POLYDATA (null: none), become a group of vertices, one of edges and one of faces. Returns the cells that became elements.
[[nodiscard]] std::vector<std::size_t> add_vtk_elements(Mesh& mesh, SourceFile& source, const VtkCells& cells,
                                                        std::span<const std::uint8_t> kinds, const VtkCells* vertices = nullptr,
                                                        const VtkCells* lines = nullptr);

/// Reduces a field to these rows; the source notes that other formats will lack the rest.
void keep_rows(Field& field, std::span<const std::size_t> rows, SourceFile& source);

/// Type number in VTK of a kind of element.
[[nodiscard]] int vtk_cell_type(ElementKind kind) noexcept;

// Order of an element's corners in VTK's formats and those that use its numbering (SU2), compared with ours. It differs only for wedges: by
// VTK's definition the triangle (0, 1, 2) looks away from (3, 4, 5), with Gmsh, MEDIT and here it looks towards it.
// https://vtk.org/doc/nightly/html/classvtkWedge.html

/// Converts from VTK's order to ours, or back: its own inverse. `c`: the info(kind).corners corners.
constexpr void exchange_vtk_order(ElementKind kind, Index* c) noexcept {
  if (kind != ElementKind::Wedge) return;
  std::swap(c[1], c[2]);
  std::swap(c[4], c[5]);
}

/// Corners by file_corners(), in VTK's order.
[[nodiscard]] inline FileCorners vtk_corners(const Mesh& mesh, std::size_t element) {
  FileCorners corners = file_corners(mesh, element);
  exchange_vtk_order(mesh.elements.kind(static_cast<Index>(element)), corners.at.data());
  return corners;
}

// Structured grids of VTK's formats: points in rows, columns and layers, whose cells are not listed.

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
