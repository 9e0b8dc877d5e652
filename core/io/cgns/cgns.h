#pragma once
// CGNS files (.cgns) in HDF5. https://cgns.github.io/CGNS_docs_current/sids/
//
// Reads with HDF5's library alone: a CGNS file is a tree of HDF5 groups, each with a label for its type, and with its numbers in an array "
// data".

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/array_patch.h"
#include "core/io/arrays/hdf5_file.h"
#include "core/io/cell_table.h"
#include "core/io/format.h"

namespace dmoscope {

/// Roles of groups from a CGNS file.
inline constexpr std::string_view kCgnsZone = "zone";
inline constexpr std::string_view kCgnsSection = "section";
inline constexpr std::string_view kCgnsCondition = "boundary patch";
inline constexpr std::string_view kCgnsFamily = "family";

struct CgnsNode {
  std::string path, name, label;  // label such as "Zone_t"
};

/// The tree of a CGNS file.
class CgnsTree {
 public:
  explicit CgnsTree(Hdf5File& file) : file_(file) {}
  [[nodiscard]] Hdf5File& file() const noexcept { return file_; }
  [[nodiscard]] std::vector<CgnsNode> children(const std::string& path) const;
  /// Children of a node with this label.
  [[nodiscard]] std::vector<CgnsNode> children(const CgnsNode& of, std::string_view label) const;
  /// First child of a node with this label.
  [[nodiscard]] std::optional<CgnsNode> child(const CgnsNode& of, std::string_view label) const;
  [[nodiscard]] std::optional<CgnsNode> named(const CgnsNode& of, std::string_view name) const;
  /// The data of a node.
  [[nodiscard]] std::vector<std::int64_t> wholes(const CgnsNode& node) const { return file_.wholes(array(node)); }
  [[nodiscard]] std::string text(const CgnsNode& node) const;
  [[nodiscard]] static std::string array(const CgnsNode& node) { return node.path + "/ data"; }
  /// Throws InputError for a node: "/Base/Zone: ...".
  [[noreturn]] void fail(const CgnsNode& node, const std::string& what) const;

 private:
  Hdf5File& file_;
};

/// A zone, structured or not.
struct CgnsZone {
  CgnsNode node;
  bool structured = false;
  std::vector<std::int64_t> sizes;  // numbers of vertices along each index; a single one in an unstructured zone
  Index first = 0, count = 0;       // range of its points, among those of all zones
};

/// The zones of a file and their points. Points of different zones at exactly the same place are one vertex.
struct CgnsPoints {
  std::vector<CgnsZone> zones;
  int cell_dimension = 3;
  std::string base;
  std::vector<Vec3> positions;   // positions of the vertices
  std::vector<Index> vertex_of;  // vertex of each point
  std::size_t joined = 0;        // number of points that are a vertex of another zone, too
  CoordinateArrays coordinates;
};
/// Reads zones and points. Throws InputError.
[[nodiscard]] CgnsPoints read_cgns_points(const CgnsTree& tree, SourceFile* notes);

/// The shape of an ElementType_t; none for types that are not read.
[[nodiscard]] std::optional<CellShape> cgns_shape(std::int64_t type) noexcept;
/// Name of an ElementType_t: "TETRA_10".
[[nodiscard]] std::string cgns_type_name(std::int64_t type);

/// A boundary condition: elements of the zone by their numbers, vertices, or a part of a structured zone's surface.
struct CgnsCondition {
  std::string name, family;
  bool of_vertices = false;
  bool of_range = false;
  std::vector<std::int64_t> numbers;  // numbers from 1; of a range its begin and its end
  std::string location;
};
[[nodiscard]] std::vector<CgnsCondition> read_cgns_conditions(const CgnsTree& tree, const CgnsZone& zone);

/// The cells of all zones, and their groups.
struct CgnsCells {
  CellTable cells;
  std::vector<OriginLabels> labels;
  std::vector<Group> vertex_groups;
  std::vector<std::size_t> first_cell;  // first cell of each zone, and the number of cells at the end
};
/// Reads the cells. Throws InputError, Cancelled.
[[nodiscard]] CgnsCells read_cgns_cells(const CgnsTree& tree, const CgnsPoints& points, SourceFile& source, Progress& progress);

/// Pairs of vertices that connections of zones identify, point by point, and that are not the same already: each pair once, the lower
/// number first. Throws InputError.
[[nodiscard]] std::vector<std::array<Index, 2>> read_cgns_pairs(const CgnsTree& tree, const CgnsPoints& points);

}  // namespace dmoscope
