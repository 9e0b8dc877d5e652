#pragma once
// Stars of the free vertices laid out for speed: renumbered so that the order of the visits is the order in memory.

#include <cstdint>
#include <vector>

#include "core/mesh/colouring.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"

namespace dmoscope {

class ThreadPool;

/// Star of one free vertex. Its other corners stand in StarTable::others from `first` on, as ranks. Fan: the ring of a closed fan of
/// triangles; triangle i is (vertex, ring[i], ring[i + 1]), the last one closed by ring[0]. Otherwise two corners a triangle, then three a
/// quadrilateral, in the elements' order.
struct StarShape {
  enum class Kind : std::uint8_t { Fan, General, Alone };  // Alone: too large for lanes
  std::uint32_t first = 0;
  std::uint8_t triangles = 0, quadrilaterals = 0;  // 0 for a star that is Alone
  Kind kind = Kind::Alone;
};

/// Sizes of the largest stars that have a place in lanes.
inline constexpr std::size_t kMaxFan = 32, kMaxTriangles = 16, kMaxQuadrilaterals = 6;

struct StarTable {
  /// Vertex of the mesh of each rank: first the free ones in the order of the visits, then all others.
  std::vector<Index> vertex_of_rank;
  std::vector<Index> rank_of_vertex;  // inverse of vertex_of_rank
  /// Shapes of the visits, and one more that ends the last.
  std::vector<StarShape> shapes;
  std::vector<Index> others;
};

/// Star of one vertex, laid out as in the table: appends its other corners to `others`, as vertices.
[[nodiscard]] StarShape star_shape(const Mesh& mesh, const Topology& topology, Index vertex, std::vector<Index>& others);

/// Builds the table. `colouring`: that of the free vertices, in the order of the visits. Throws UsageError where 32 bits cannot count the
/// stars' corners.
[[nodiscard]] StarTable build_star_table(const Mesh& mesh, const Topology& topology, const Colouring& colouring, ThreadPool* pool);

}  // namespace dmoscope
