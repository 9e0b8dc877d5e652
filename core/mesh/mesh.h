#pragma once
// The mesh as its file gave it: positions, elements, and all that the file carried with them.

#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/memory.h"
#include "core/base/vec.h"

namespace dmoscope {

struct ThinMesh;   // thin.h: the cells of a mesh of front faces
class SourceFile;  // core/io/reading/source_file.h: the bytes that a mesh was read from, with the place of every coordinate

enum class ElementKind : std::uint8_t { Triangle, Quadrilateral, Tetrahedron, Hexahedron, Wedge, Pyramid };
inline constexpr std::size_t kElementKindCount = 6;

struct ElementKindInfo {
  std::string_view name;    // such as "triangle"
  std::string_view plural;  // such as "triangles"
  Index corners;
  int dimension;  // dimension, 2 or 3
};
inline constexpr std::array<ElementKindInfo, kElementKindCount> kElementKinds{{{"triangle", "triangles", 3, 2},
                                                                               {"quadrilateral", "quadrilaterals", 4, 2},
                                                                               {"tetrahedron", "tetrahedra", 4, 3},
                                                                               {"hexahedron", "hexahedra", 8, 3},
                                                                               {"wedge", "wedges", 6, 3},
                                                                               {"pyramid", "pyramids", 5, 3}}};
[[nodiscard]] constexpr const ElementKindInfo& info(ElementKind kind) { return kElementKinds[static_cast<std::size_t>(kind)]; }

/// Turns an element inside out, keeping its first corner: reverses the winding of a triangle or quadrilateral, and that of every face of a
/// volume element. Its own inverse. `c`: the info(kind).corners corners.
constexpr void flip_corners(ElementKind kind, Index* c) noexcept {
  switch (kind) {
    case ElementKind::Triangle:
      return std::swap(c[1], c[2]);
    case ElementKind::Quadrilateral:
    case ElementKind::Tetrahedron:
    case ElementKind::Pyramid:
      return std::swap(c[1], c[3]);
    case ElementKind::Hexahedron:
      std::swap(c[1], c[3]);
      return std::swap(c[5], c[7]);
    case ElementKind::Wedge:
      std::swap(c[1], c[2]);
      return std::swap(c[4], c[5]);
  }
}

/// Elements of any mix of kinds; all corners in one array, in Gmsh's order for each kind (VTK's, but for wedges: see io/vtk/vtk_cells.h).
class ElementTable {
 public:
  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(kinds_.size()); }
  [[nodiscard]] ElementKind kind(Index e) const noexcept { return kinds_[e]; }
  [[nodiscard]] std::span<const Index> corners(Index e) const noexcept {
    return {corners_.data() + offsets_[e], corners_.data() + offsets_[e + 1]};
  }
  [[nodiscard]] std::span<const ElementKind> kinds() const noexcept { return kinds_; }
  /// All corners of all elements, element after element.
  [[nodiscard]] std::span<const Index> all_corners() const noexcept { return corners_; }
  /// The size() + 1 offsets into all_corners().
  [[nodiscard]] std::span<const Index> offsets() const noexcept { return offsets_; }
  void reserve(std::size_t elements, std::size_t corners) {
    reserve_large(kinds_, elements);
    reserve_large(offsets_, elements + 1);
    reserve_large(corners_, corners);
  }
  /// Appends one element; corners.size() must be info(kind).corners.
  void add(ElementKind kind, std::span<const Index> corners) {
    assert(corners.size() == info(kind).corners);
    kinds_.push_back(kind);
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    offsets_.push_back(static_cast<Index>(corners_.size()));
  }
  /// Appends all elements of another table.
  void append(const ElementTable& other) {
    kinds_.insert(kinds_.end(), other.kinds_.begin(), other.kinds_.end());
    const auto before = static_cast<Index>(corners_.size());
    corners_.insert(corners_.end(), other.corners_.begin(), other.corners_.end());
    for (std::size_t e = 1; e < other.offsets_.size(); ++e) offsets_.push_back(before + other.offsets_[e]);
  }
  /// Removes all elements, keeping the reserved memory.
  void clear() noexcept {
    kinds_.clear();
    corners_.clear();
    offsets_.resize(1);
  }
  /// Turns an element inside out, see flip_corners().
  void flip(Index e) noexcept { flip_corners(kinds_[e], corners_.data() + offsets_[e]); }

 private:
  std::vector<ElementKind> kinds_;
  std::vector<Index> offsets_{0};
  std::vector<Index> corners_;
};

/// Numbers that the file carried for every vertex or every element (depth of a fort.14, VTK point and cell data).
struct Field {
  enum class On { Vertices, Elements };
  std::string name;
  On on = On::Vertices;
  int components = 1;           // values.size() == components * (number of vertices or elements)
  std::string type = "double";  // the file's own word for its scalar ("float", "int", ...)
  std::string role{};           // the file's own word for its kind ("SCALARS", "VECTORS", "depth", ...), may be empty
  std::vector<double> values{};
  bool said_material = false;  // the user said that it names materials, see name_materials()
  /// Place in the file that the field was read from: for errors that are found late, and to write it again.
  struct Place {
    std::uint64_t begin = 0;      // byte of its first row; of a named array, the number of its first number
    std::uint32_t words = 0;      // text: words from row to row; 0: not known
    bool with_positions = false;  // each row is at the place of its vertex
    std::uint32_t at = 0;         // from the begin of a row to its first number: words; in a binary file bytes
    std::uint32_t bytes = 0;      // binary: bytes from row to row; 0: text, or not known
    std::string array{};          // name of its array, in a file of named arrays
    std::vector<Index> rows{};    // vertex or element of each row; empty: all, in their order
  } place{};
};

/// A named set that the file carried: boundary strings of fort.14, markers of SU2.
struct Group {
  std::string name;
  std::string role;   // role such as "open boundary", "land boundary", "marker", ...
  int code = 0;       // the file's number for it (IBTYPE of fort.14), 0 if it has none
  int dimension = 0;  // 0: members are vertices; 1: members are edges, two vertices each; 2: members are elements, or else `faces` is used
  std::vector<Index> members{};  // members, counted from 0
  ElementTable faces{};          // dimension 2, members empty: faces of a volume mesh by their corners, in the file's own winding

  [[nodiscard]] bool of_elements() const noexcept { return dimension == 2 && faces.size() == 0; }
  /// The vertices of a group of vertices, edges or faces, some more than once; empty for a group of elements.
  [[nodiscard]] std::span<const Index> vertices() const noexcept {
    if (of_elements()) return {};
    return faces.size() > 0 ? faces.all_corners() : std::span<const Index>(members);
  }
};

struct Mesh {
  std::string name;   // file name without folder, for titles
  std::string title;  // the file's own title line, may be empty
  std::vector<Vec3> positions;
  ElementTable elements;
  std::vector<Field> fields;
  std::vector<Group> groups;
  /// Pairs of vertices that the file declares periodic: one vertex, a period apart.
  std::vector<std::array<Index, 2>> periodic{};
  /// Elements whose winding was reversed after reading (see orientation.h); empty if none, else one entry per element.
  std::vector<std::uint8_t> flipped;
  /// Whether the file holds 32-bit coordinates, or says so: moved vertices are rounded to such, so that the mesh judged is the mesh
  /// written.
  bool single_precision = false;
  /// Positions in the file, in longitude and latitude, of a mesh that was mapped (geographic.h); null: `positions`.
  std::shared_ptr<const std::vector<Vec3>> degrees{};
  /// The cells of a mesh one cell thick that was replaced by its front (thin.h); null: the elements are the file's own.
  std::shared_ptr<const ThinMesh> thin{};
  /// The file as it was read; writing the same format patches only the coordinates that changed. May be null.
  std::shared_ptr<const SourceFile> source;

  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(positions.size()); }
};

}  // namespace dmoscope
