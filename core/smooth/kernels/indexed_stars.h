#pragma once
// Stars of all free vertices laid out for speed, in the order of the visits: each of a star's other vertices is known once.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vec.h"
#include "core/input/input_mesh.h"
#include "core/mesh/colouring.h"
#include "core/smooth/kernels/indexed_star.h"

namespace dmoscope {

class ThreadPool;

class IndexedStars {
 public:
  struct Star {
    std::span<const Index> vertices;  // other vertices of the star, each once
    IndexedStar elements;
    bool fits = false;  // no kind has more than kMaxSolids elements; else there are no vertices and no elements
  };

  /// Makes the stars of a colouring's vertices, which are visited in its order, in a planar mesh or a volume, which need not outlive it.
  IndexedStars(const InputMesh& input, const Colouring& colouring, ThreadPool* pool);

  /// Star of one of those vertices.
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
    void add(const InputMesh& input, Index vertex);
  };
  std::vector<Chunk> chunks_;
  std::vector<Index> visit_of_vertex_;  // empty: there is one star
};

}  // namespace dmoscope
