#pragma once
// The star of a vertex of a volume with each of its other vertices known once, and the stars of all free vertices laid out so, in the order
// of the visits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/colouring.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"

namespace dmoscope {

class ThreadPool;

/// At most this many elements of a kind; other stars are the plain search's.
inline constexpr std::size_t kMaxSolids = 96;

/// The kinds of elements of a star, in the order in which they stand.
enum class StarKind : std::uint8_t { Tetrahedra, Hexahedra, Wedges, Pyramids, Tips };
inline constexpr std::size_t kStarKinds = 5;
/// Of an element of a kind: the corners that are not the star's vertex, in the order of StarTetrahedron and so on.
inline constexpr std::array<std::uint8_t, kStarKinds> kOtherCorners{3, 7, 5, 4, 4};

/// The elements of a star. Plain data, for kernels.
struct IndexedStar {
  const std::uint16_t* corners = nullptr;  // element after element the other corners, by their place among the star's other vertices
  std::uint8_t counts[kStarKinds] = {};    // elements of each kind
};

class IndexedStars {
 public:
  struct Star {
    std::span<const Index> vertices;  // the others, each once
    IndexedStar elements;
    bool fits = false;  // no kind has more than kMaxSolids elements; else there are no vertices and no elements
  };

  /// Of the vertices of a colouring, which are visited in its order. The mesh need not outlive it.
  IndexedStars(const Mesh& mesh, const Topology& topology, const Colouring& colouring, ThreadPool* pool);
  /// Of one vertex.
  IndexedStars(const Mesh& mesh, const Topology& topology, Index vertex);

  /// Of one of those vertices.
  [[nodiscard]] Star of(Index vertex) const {
    const std::size_t visit = visit_of_vertex_.empty() ? 0 : visit_of_vertex_[vertex];
    const Chunk& chunk = chunks_[visit / kStarsAtOnce];
    const Shape& shape = chunk.shapes[visit % kStarsAtOnce];
    Star star{{chunk.vertices.data() + shape.first_vertex, shape.vertices}, {chunk.corners.data() + shape.first_corner}, shape.fits};
    for (std::size_t kind = 0; kind < kStarKinds; ++kind) star.elements.counts[kind] = shape.counts[kind];
    return star;
  }

 private:
  static constexpr std::size_t kStarsAtOnce = 1024;
  struct Shape {
    std::uint32_t first_vertex = 0, first_corner = 0;
    std::uint16_t vertices = 0;
    std::array<std::uint8_t, kStarKinds> counts{};
    bool fits = true;
  };
  struct Chunk {
    std::vector<Shape> shapes;
    std::vector<Index> vertices;
    std::vector<std::uint16_t> corners;
    void add(const Mesh& mesh, const Topology& topology, Index vertex);
  };
  std::vector<Chunk> chunks_;
  std::vector<Index> visit_of_vertex_;  // empty: there is one star
};

}  // namespace dmoscope
