#pragma once
// The part of a mesh that a rank smooths: the vertices that it owns, all elements around them, and the other corners of these.

#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "mpi/mesh/mesh_block.h"

namespace dmoscope {

struct Share {
  std::uint64_t vertex_count = 0, element_count = 0;  // counts of the whole mesh
  std::vector<WholeIndex> vertices, elements;         // numbers in the whole mesh, ascending, by vertex and element of the share
  std::vector<int> owner;                             // by vertex: its owner's rank
  std::vector<std::uint8_t> home;                     // by element: 1 on the one rank that counts it
  std::vector<std::uint8_t> named;                    // by vertex: 1 if owned and marked in the block; empty: none
  Mesh mesh;                                          // without fields; its groups of elements tell materials apart
  /// Returns the share's number of a vertex of the whole mesh; kNoIndex: it is not in the share.
  [[nodiscard]] Index find_vertex(WholeIndex vertex) const;
};

/// Marks of a block's vertices and elements that the user named. Empty: none.
struct BlockMarks {
  std::vector<std::uint8_t> vertices, elements;
  [[nodiscard]] bool any() const noexcept { return !vertices.empty() || !elements.empty(); }
};

/// Makes the rank's share. `part`: the rank of each of the block's vertices; `materials`: numbers of block.fields. Moves the block's
/// contents out, but for the ranges. Throws InputError if a share has more vertices or elements than an Index counts.
[[nodiscard]] Share make_share(const World& world, MeshBlock& block, const std::vector<int>& part, std::span<const std::size_t> materials,
                               const BlockMarks& marks);

}  // namespace dmoscope
