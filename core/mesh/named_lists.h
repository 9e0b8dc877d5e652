#pragma once
// Tells lines, faces and points that a file names on purpose from lists that enumerate all edges, faces or vertices of a mesh: such a list
// names a vertex together with everything around it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/faces.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// Whether a group is a boundary string of a fort.14: vertices in order.
[[nodiscard]] bool is_string(const Group& group);
/// Whether a group is one of MEDIT's RequiredVertices, RequiredEdges, RequiredTriangles and RequiredQuadrilaterals, in whatever case.
[[nodiscard]] bool is_required(const Group& group);

enum class NamedKind : std::uint8_t { Faces, Lines, Points };

/// All that groups of one kind name in a mesh. The mesh must outlive it.
class NamedList {
 public:
  /// Gathers the names. `groups`: of vertices (Points), edges (Lines) or faces of a volume mesh (Faces).
  NamedList(NamedKind kind, std::span<const Group* const> groups, const Mesh& mesh, const Topology& topology);
  /// Whether everything of this kind at the vertex, and at all vertices of its elements, is named. At a crossing of lines all edges of a
  /// vertex may be named, but not those of its neighbours.
  [[nodiscard]] bool surrounds(Index vertex);

 private:
  [[nodiscard]] bool full(Index vertex);
  [[nodiscard]] bool all_named_at(Index vertex) const;
  [[nodiscard]] bool named(std::span<const Index> corners) const;
  void add(std::span<const Index> corners) { keys_.push_back(corner_set(corners)); }
  void add(const Group& group);

  NamedKind kind_;
  const Mesh& mesh_;
  const Topology& topology_;
  std::vector<std::array<Index, 4>> keys_;  // all named edges or faces, ascending
  std::vector<std::uint8_t> named_;         // points: whether each vertex is named
  std::vector<std::uint8_t> is_full_;       // by vertex, whether all around it is named: 0 not asked yet, 1 no, 2 yes
};

}  // namespace dmoscope
