#pragma once
// Meshes, made from arrays or files, and back.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/progress.h"

namespace dmo {

/// Number of a vertex or cell, from 0 on.
using Index = std::uint32_t;

/// Kinds of cells. Their corners have VTK's order.
enum class CellKind : std::uint8_t { Triangle, Quadrilateral, Tetrahedron, Hexahedron, Wedge, Pyramid };
/// Returns the number of corners: 3, 4, 4, 8, 6 or 5, in the order of CellKind.
[[nodiscard]] DMO_API std::size_t corner_count(CellKind kind);

/// Cells of any mix of kinds, as a view of arrays.
struct Cells {
  std::size_t count = 0;
  const CellKind* kinds = nullptr;      // count kinds
  const Index* offsets = nullptr;       // count + 1 offsets: the corners of cell c are connectivity[offsets[c]] up to offsets[c + 1]
  const Index* connectivity = nullptr;  // offsets[count] numbers of vertices
};

/// Data of each vertex, or of each cell. Cell data of one component whose name is one that programs use for materials ("material",
/// "gmsh:physical", "region" ...) make interfaces between cells of different values; interfaces stay.
struct Numbers {
  std::string name;
  std::vector<double> values;  // the values of the first vertex or cell, then those of the next
  std::size_t components = 1;  // values of each vertex or cell
  bool whole = false;          // whether their type is one of whole numbers
};
using PointData = Numbers;
using CellData = Numbers;

/// Points, lines, faces or cells that a file names. Cells of different groups have an interface between them, which stays.
struct Group {
  std::string name;
  std::string kind;             // the file's own word: "physical group", "marker", "land boundary"
  std::string members;          // "points", "lines", "faces" (of a volume mesh) or "cells"
  std::optional<int> number;    // number that the file gives the group
  std::vector<Index> cells;     // the cells of a group of cells
  std::vector<Index> vertices;  // all vertices of the group, ascending
};

/// A closed curve of the boundary of a planar or surface mesh.
struct BoundaryLoop {
  std::vector<Index> vertices;  // in order, with the mesh to the left
  double length = 0.0;
  double area = 0.0;     // enclosed, in square mesh units; of a loop that is not planar: the largest area of its projections
  std::size_t part = 0;  // the part that the loop bounds: parts()[part]
  bool outer = false;    // planar meshes: whether the part lies inside the loop
};

/// Immutable mesh: smooth() returns a new one, which shares all but the positions with the old. Cheap to copy. All members may be called
/// from several threads.
class DMO_API Mesh {
 public:
  /// Copies the arrays. `positions`: vertices x 3, mesh units; in a planar mesh one of the coordinates is the same everywhere. Throws
  /// InputError for null pointers, corners that do not exist or repeat, a wrong number of corners for the kind, offsets that do not rise
  /// from 0 on, coordinates that are not finite, planar and volume cells mixed, and data of another length.
  Mesh(const double* positions, std::size_t vertices, const Cells& cells, const std::vector<CellData>& data = {},
       const std::vector<PointData>& point_data = {}, const Progress& progress = {});
  ~Mesh();
  Mesh(const Mesh&);
  Mesh& operator=(const Mesh&);

  /// Reads a file of any format that the program reads. Throws InputError.
  [[nodiscard]] static Mesh read(const std::string& path, const Progress& progress = {});
  /// Writes a file of the format that the name's extension gives, whole or not at all. A file of the format that was read keeps its other
  /// content, such as groups. Returns a sentence for each thing that the format cannot carry. Throws OutputError, UsageError.
  std::vector<std::string> write(const std::string& path, const Progress& progress = {}) const;

  /// Returns all of the mesh, with the other content of its file, as bytes for another or a later process, which smooths and writes it as
  /// this one does.
  [[nodiscard]] std::string to_bytes() const;
  /// Makes a mesh from bytes of to_bytes() of the same version. Throws InputError for others, and for damaged ones.
  [[nodiscard]] static Mesh from_bytes(std::string_view bytes, const Progress& progress = {});

  [[nodiscard]] std::size_t vertex_count() const;
  [[nodiscard]] std::size_t cell_count() const;
  /// Positions in mesh units, vertex_count() x 3; valid as long as this mesh or a copy exists.
  [[nodiscard]] const double* positions() const;
  /// The cells as they were given; valid as long as this mesh or a copy exists.
  [[nodiscard]] Cells cells() const;
  /// Cell data that was given or read from the file.
  [[nodiscard]] std::vector<CellData> cell_data() const;
  [[nodiscard]] std::vector<PointData> point_data() const;
  [[nodiscard]] std::vector<Group> groups() const;
  /// Finds the vertices that a name names, ascending: "group:wall" or "wall" (a group of the file), "material=3" (data of points or cells),
  /// "box:X0,Y0,X1,Y1" (closed ranges; six numbers in space), "loop:1" and "part:1" (see below), "3,7-9". Throws UsageError that lists what
  /// the mesh has.
  [[nodiscard]] std::vector<Index> vertices(std::string_view name) const;
  /// Finds the boundary loops of the mesh at its present positions, in the order of their names for vertices(), loop:1, loop:2 ...; none
  /// of a volume mesh. Takes about two seconds for a million vertices.
  [[nodiscard]] std::vector<BoundaryLoop> boundary_loops() const;
  /// Finds the sets of cells connected across edges, in the order of part:1, part:2 ...; none of a volume mesh. Takes as long as
  /// boundary_loops().
  [[nodiscard]] std::vector<std::vector<Index>> parts() const;
  /// Finds the neighbours of a vertex across edges in order, counter-clockwise if its cells are; on the boundary from edge to edge. Empty
  /// in a volume mesh. Throws UsageError for a vertex that does not exist.
  [[nodiscard]] std::vector<Index> ring(std::size_t vertex) const;
  /// Whether it has volume cells.
  [[nodiscard]] bool is_volume() const;
  /// Whether it is curved: its cells are planar and do not lie in one plane.
  [[nodiscard]] bool is_surface() const;
  /// Whether vertices are on the boundary, vertex_count() values: 1 or 0; valid as long as this mesh or a copy exists.
  [[nodiscard]] const std::uint8_t* boundary() const;
  /// Whether x and y are longitude and latitude in degrees, so that the mesh is judged and smoothed on the Earth. read() takes them so if
  /// the title or the name of a fort.14 or .2dm says it; with_degrees() sets it, and throws InputError for coordinates that cannot be
  /// degrees.
  [[nodiscard]] bool in_degrees() const;
  [[nodiscard]] Mesh with_degrees(bool degrees) const;
  /// Whether this is a mesh of hexahedra and wedges one cell thick, which is judged and smoothed as the 2-D mesh of its front. read()
  /// detects it; with_thin() sets it. Positions and cells stay those of the file: the back follows the front. with_thin() throws InputError
  /// for a mesh that is not one cell thick.
  [[nodiscard]] bool thin() const;
  [[nodiscard]] Mesh with_thin(bool thin) const;
  /// Returns the mesh with other positions: vertex_count() x 3, mesh units, copied. Throws InputError as the constructor does.
  [[nodiscard]] Mesh with_positions(const double* positions, const Progress& progress = {}) const;
  /// Returns the mesh with the cell data of these names, one number a cell each, as materials whatever they are called; no names: those of
  /// known names alone. Throws UsageError for a name that no cell data have.
  [[nodiscard]] Mesh with_materials(const std::vector<std::string>& names) const;

  struct Data;
  explicit Mesh(std::shared_ptr<const Data> data);
  [[nodiscard]] const std::shared_ptr<const Data>& data() const noexcept { return data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace dmo
