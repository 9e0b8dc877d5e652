#pragma once
// The part of a mesh that a rank smooths: the vertices that it owns, all elements around them, and the other corners of these.

#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

struct Share {
  std::uint64_t vertex_count = 0, element_count = 0;  // of the whole mesh
  std::vector<WholeIndex> vertices, elements;         // numbers in the whole mesh, ascending, by vertex and element of the share
  std::vector<int> owner;                             // by vertex: a rank
  std::vector<std::uint8_t> home;                     // by element: 1 where this rank counts it, as one rank does
  std::vector<std::uint8_t> named;                    // by vertex, of owned ones: 1 where the block's marks said so; empty: none
  Mesh mesh;                                          // without fields; its groups of elements tell materials apart
  /// The share's number of a vertex of the whole mesh; kNoIndex: it has none.
  [[nodiscard]] Index find_vertex(WholeIndex vertex) const;
};

/// Marks of a block's vertices and elements: those that a person names. Empty: none.
struct BlockMarks {
  std::vector<std::uint8_t> vertices, elements;
  [[nodiscard]] bool any() const noexcept { return !vertices.empty() || !elements.empty(); }
};

/// `part`: the rank of each of the block's vertices; `materials`: numbers of block.fields. Takes the block's contents, but for the ranges.
/// Throws InputError where a share has more than an Index counts.
[[nodiscard]] Share make_share(const World& world, MeshBlock& block, const std::vector<int>& part, std::span<const std::size_t> materials,
                               const BlockMarks& marks);

}  // namespace dmoscope
