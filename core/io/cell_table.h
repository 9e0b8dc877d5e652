#pragma once
// Cells of every dimension together, as in Gmsh and MEDIT files: those of the highest dimension become the mesh's elements, the others
// groups of vertices, edges and faces.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/io/format.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Shapes of cells: points, lines, and then the kinds of elements in their order.
enum class CellShape : std::uint8_t { Point, Line, Triangle, Quadrilateral, Tetrahedron, Hexahedron, Wedge, Pyramid };
inline constexpr std::size_t kCellShapeCount = 2 + kElementKindCount;

[[nodiscard]] constexpr CellShape shape_of(ElementKind kind) noexcept { return static_cast<CellShape>(static_cast<int>(kind) + 2); }
/// Kind of element of a shape; none for points and lines.
[[nodiscard]] constexpr std::optional<ElementKind> kind_of(CellShape shape) noexcept {
  if (shape < CellShape::Triangle) return std::nullopt;
  return static_cast<ElementKind>(static_cast<int>(shape) - 2);
}
[[nodiscard]] constexpr Index corners_of(CellShape shape) noexcept {
  return shape < CellShape::Triangle ? static_cast<Index>(shape) + 1 : info(*kind_of(shape)).corners;
}
[[nodiscard]] constexpr int dimension_of(CellShape shape) noexcept {
  return shape < CellShape::Triangle ? static_cast<int>(shape) : info(*kind_of(shape)).dimension;
}

/// Cells in the file's order. Each has an origin: the number of its entity, reference or the like in the file, counted by the reader.
class CellTable {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return shapes_.size(); }
  /// The highest dimension of all cells, -1 without any.
  [[nodiscard]] int dimension() const noexcept { return dimension_; }
  [[nodiscard]] CellShape shape(std::size_t cell) const noexcept { return shapes_[cell]; }
  [[nodiscard]] std::uint32_t origin(std::size_t cell) const noexcept { return origins_[cell]; }
  [[nodiscard]] std::span<const Index> all_corners() const noexcept { return corners_; }
  /// The corners of each cell.
  [[nodiscard]] std::vector<std::span<const Index>> corners_by_cell() const;
  void reserve_more(std::size_t cells, std::size_t corners);
  /// Appends one cell with corners_of(shape) corners.
  void add(CellShape shape, const Index* corners, std::uint32_t origin) {
    shapes_.push_back(shape);
    origins_.push_back(origin);
    corners_.insert(corners_.end(), corners, corners + corners_of(shape));
    dimension_ = std::max(dimension_, dimension_of(shape));
  }

 private:
  std::vector<CellShape> shapes_;
  std::vector<std::uint32_t> origins_;
  std::vector<Index> corners_;
  int dimension_ = -1;
};

/// Name, role and number of a group made of cells.
struct GroupLabel {
  std::string name;
  std::string role;
  int code = 0;
};
/// The groups that the cells of one origin belong to.
struct OriginLabels {
  std::vector<GroupLabel> labels;
  bool of_elements = true;  // whether the mesh's elements are put into groups, too, or only other cells
};

/// Adds the cells of the highest dimension (2 or 3) to mesh.elements and all others to mesh.groups, and elements to groups if their origin
/// says so. `labels`: by origin. Beyond several thousand groups the rest forms one group, with a note. Returns the cell of each element;
/// empty if every cell is one. Throws InputError (too many corners).
[[nodiscard]] std::vector<Index> split_cells(const CellTable& cells, std::span<const OriginLabels> labels, Mesh& mesh, SourceFile& source);

/// The element of each cell, kNoIndex for one that is none. `rows`: see split_cells().
[[nodiscard]] std::vector<Index> elements_of_cells(const CellTable& cells, const Mesh& mesh, std::span<const Index> rows);

/// Values of some rows of a field: indices of any type.
template <class Rows>
[[nodiscard]] std::vector<double> rows_of_values(const Field& field, const Rows& rows) {
  const auto n = static_cast<std::ptrdiff_t>(field.components);
  std::vector<double> kept;
  kept.reserve(rows.size() * static_cast<std::size_t>(n));
  for (const auto row : rows) {
    const auto first = field.values.begin() + static_cast<std::ptrdiff_t>(row) * n;
    kept.insert(kept.end(), first, first + n);
  }
  return kept;
}

// --- For writers ---

/// A number for every group: its code if that is positive and unique among the groups of its kind (vertices, edges, faces, elements), else
/// an unused one.
[[nodiscard]] std::vector<int> numbers_of_groups(std::span<const Group> groups);
/// The number of each element's group, 0 without one; of several the first, with a note. Groups of number 0 are left out.
[[nodiscard]] std::vector<int> numbers_of_elements(const Mesh& mesh, std::span<const int> numbers, std::string_view format_title,
                                                   Notes& notes);

}  // namespace dmoscope
