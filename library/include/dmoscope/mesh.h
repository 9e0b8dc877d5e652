#pragma once
// Meshes: from arrays or files, and back.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/progress.h"

namespace dmo {

/// Of vertices and cells, from 0 on.
using Index = std::uint32_t;

/// Kinds of cells. Their corners have VTK's order.
enum class CellKind : std::uint8_t { Triangle, Quadrilateral, Tetrahedron, Hexahedron, Wedge, Pyramid };
/// 3, 4, 4, 8, 6, 5.
[[nodiscard]] DMO_API std::size_t corner_count(CellKind kind);

/// Cells of any mix of kinds, in arrays that somebody else owns.
struct Cells {
  std::size_t count = 0;
  const CellKind* kinds = nullptr;      // count of them
  const Index* offsets = nullptr;       // count + 1: the corners of cell c are connectivity[offsets[c]] up to offsets[c + 1]
  const Index* connectivity = nullptr;  // offsets[count] vertices
};

/// Numbers of each vertex, or of each cell. Where each cell has one and its name is one that programs use for materials ("material",
/// "gmsh:physical", "region" ...), what lies between cells of different numbers is an interface, which stays.
struct Numbers {
  std::string name;
  std::vector<double> values;  // those of the first vertex or cell, then of the next
  std::size_t components = 1;  // how many each has
  bool whole = false;          // are they of a type of whole numbers?
};
using PointData = Numbers;
using CellData = Numbers;

/// Cells that a file names. What lies between cells of different groups is an interface, likewise.
struct CellGroup {
  std::string name;
  std::vector<Index> cells;
};

/// A closed curve of the boundary of a planar or surface mesh.
struct BoundaryLoop {
  std::vector<Index> vertices;  // in order, with the mesh to the left
  double length = 0.0;
  double area = 0.0;     // that it encloses; of a loop that is not planar: of its shadow where that is largest
  std::size_t part = 0;  // that it bounds: parts()[part]
  bool outer = false;    // of a planar mesh: its part lies inside of it
};

/// A mesh that does not change: smooth() gives a new one, which shares all but the positions with the old. Cheap to copy. All members may
/// be called from several threads.
class DMO_API Mesh {
 public:
  /// Copies the arrays. `positions`: vertices x 3, mesh units; of a planar mesh one of the coordinates is the same everywhere. Throws
  /// InputError: null pointers, corners that do not exist or repeat, a number of corners that the kind has not, offsets that do not rise
  /// from 0 on, coordinates that are not finite, planar and volume cells mixed, data of another length.
  Mesh(const double* positions, std::size_t vertices, const Cells& cells, const std::vector<CellData>& data = {},
       const std::vector<PointData>& point_data = {}, const Progress& progress = {});
  ~Mesh();
  Mesh(const Mesh&);
  Mesh& operator=(const Mesh&);

  /// Reads a file of any format that the program reads. Throws InputError.
  [[nodiscard]] static Mesh read(const std::string& path, const Progress& progress = {});
  /// Writes by the name's extension, whole or not at all. What the file held that was read, such as groups, stands in one of its format
  /// again. Returns a sentence for each thing that the format cannot carry. Throws OutputError, UsageError.
  std::vector<std::string> write(const std::string& path, const Progress& progress = {}) const;

  /// All of the mesh, with what its file held, for another process or a later one: it is smoothed and written as this one is.
  [[nodiscard]] std::string to_bytes() const;
  /// Of bytes that to_bytes() of the same version made. Throws InputError for others, and where they were damaged.
  [[nodiscard]] static Mesh from_bytes(std::string_view bytes, const Progress& progress = {});

  [[nodiscard]] std::size_t vertex_count() const;
  [[nodiscard]] std::size_t cell_count() const;
  /// vertex_count() x 3, as long as this mesh or a copy lives.
  [[nodiscard]] const double* positions() const;
  /// As they came in; likewise.
  [[nodiscard]] Cells cells() const;
  /// What was given, or what the file held.
  [[nodiscard]] std::vector<CellData> cell_data() const;
  [[nodiscard]] std::vector<PointData> point_data() const;
  [[nodiscard]] std::vector<CellGroup> cell_groups() const;
  /// The boundary loops of the mesh as it stands, in the order in which the option "fix" knows them as loop:1, loop:2 ...; none of a volume
  /// mesh. Worked out at each call, in about two seconds for a million vertices.
  [[nodiscard]] std::vector<BoundaryLoop> boundary_loops() const;
  /// Cells connected across edges, as part:1, part:2 ...; likewise.
  [[nodiscard]] std::vector<std::vector<Index>> parts() const;
  /// The neighbours of a vertex across edges in order, counter-clockwise where its cells are; on the boundary from edge to edge. Empty in a
  /// volume mesh. Throws UsageError for a vertex that does not exist.
  [[nodiscard]] std::vector<Index> ring(std::size_t vertex) const;
  /// Has it volume cells?
  [[nodiscard]] bool is_volume() const;
  /// Is it curved: planar cells that do not lie in a plane?
  [[nodiscard]] bool is_surface() const;
  /// vertex_count() of them: 1 on the boundary, else 0; as long as this mesh or a copy lives.
  [[nodiscard]] const std::uint8_t* boundary() const;
  /// Are x and y longitude and latitude in degrees, so that the mesh is judged and smoothed on the Earth? read() takes them so where the
  /// title or the name of a fort.14 or .2dm says it; with_degrees() says it, or that they are not. Throws InputError for what cannot be
  /// degrees.
  [[nodiscard]] bool in_degrees() const;
  [[nodiscard]] Mesh with_degrees(bool degrees) const;
  /// Is this a mesh of hexahedra and wedges one cell thick, which is judged and smoothed as the 2-D mesh of its front? read() finds it out;
  /// with_thin() says it, or that its cells count. Its positions and cells stay those of the file: the back follows the front. Throws
  /// InputError for what is not one cell thick.
  [[nodiscard]] bool thin() const;
  [[nodiscard]] Mesh with_thin(bool thin) const;
  /// The same mesh with its vertices elsewhere: vertex_count() x 3, copied. Throws InputError as the constructor does.
  [[nodiscard]] Mesh with_positions(const double* positions, const Progress& progress = {}) const;
  /// The same mesh, in which the cell data of these names, one number a cell each, name materials whatever they are called; no names: those
  /// of known names alone. Throws UsageError for a name that no cell data have.
  [[nodiscard]] Mesh with_materials(const std::vector<std::string>& names) const;

  struct Data;
  explicit Mesh(std::shared_ptr<const Data> data);
  [[nodiscard]] const std::shared_ptr<const Data>& data() const noexcept { return data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace dmo
