#include "core/smooth/kernels/star_table.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/thread_pool.h"

namespace dmoscope {

namespace {

constexpr std::size_t kStarsAtOnce = 8192;  // vertices a chunk

/// What one chunk of vertices makes; `first` of its shapes counts from the chunk's own beginning. No ranks: vertices stand for them.
class Chunk {
 public:
  Chunk(const Mesh& mesh, const Topology& topology, std::span<const Index> rank) : mesh_(mesh), topology_(topology), rank_(rank) {}

  StarShape add(Index vertex) {
    const auto star = topology_.star(vertex);
    StarShape shape;
    shape.first = static_cast<std::uint32_t>(others.size());
    pairs_.clear();
    triples_.clear();
    for (const Incidence& at : star) {
      const auto corners = mesh_.elements.corners(at.element);
      auto& list = corners.size() == 3 ? pairs_ : triples_;
      for (std::size_t i = 1; i < corners.size(); ++i) list.push_back(rank_of(corners[(at.corner + i) % corners.size()]));
    }
    const std::size_t triangles = pairs_.size() / 2, quadrilaterals = triples_.size() / 3;
    if (quadrilaterals == 0 && triangles <= kMaxFan && add_ring()) {
      shape.kind = StarShape::Kind::Fan;
    } else {
      others.insert(others.end(), pairs_.begin(), pairs_.end());
      others.insert(others.end(), triples_.begin(), triples_.end());
      if (triangles > kMaxTriangles || quadrilaterals > kMaxQuadrilaterals) return shape;
      shape.kind = StarShape::Kind::General;
    }
    shape.triangles = static_cast<std::uint8_t>(triangles);
    shape.quadrilaterals = static_cast<std::uint8_t>(quadrilaterals);
    return shape;
  }

  std::vector<Index> others;

 private:
  [[nodiscard]] Index rank_of(Index vertex) const { return rank_.empty() ? vertex : rank_[vertex]; }

  /// Chains the triangles (b, c) of `pairs_` into one closed ring; adds nothing where they form none.
  bool add_ring() {
    const std::size_t count = pairs_.size() / 2;
    if (count < 3) return false;
    std::array<Index, kMaxFan> ring;
    ring[0] = pairs_[0];
    Index end = pairs_[1];
    std::uint64_t used = 1;
    for (std::size_t i = 1; i < count; ++i) {
      ring[i] = end;
      std::size_t next = 1;
      while (next < count && ((used >> next & 1U) != 0 || pairs_[2 * next] != end)) ++next;
      if (next == count) return false;
      used |= std::uint64_t{1} << next;
      end = pairs_[2 * next + 1];
    }
    if (end != ring[0]) return false;
    others.insert(others.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(count));
    return true;
  }

  const Mesh& mesh_;
  const Topology& topology_;
  std::span<const Index> rank_;
  std::vector<Index> pairs_, triples_;
};

/// Ranks of all vertices; fills their inverse.
std::vector<Index> rank_vertices(std::size_t count, std::span<const Index> visits, std::vector<Index>& vertex_of_rank) {
  std::vector<Index> rank(count, kNoIndex);
  vertex_of_rank.assign(visits.begin(), visits.end());
  vertex_of_rank.reserve(count);
  for (std::size_t i = 0; i < visits.size(); ++i) rank[visits[i]] = static_cast<Index>(i);
  for (Index v = 0; v < count; ++v) {
    if (rank[v] != kNoIndex) continue;
    rank[v] = static_cast<Index>(vertex_of_rank.size());
    vertex_of_rank.push_back(v);
  }
  return rank;
}

}  // namespace

StarShape star_shape(const Mesh& mesh, const Topology& topology, Index vertex, std::vector<Index>& others) {
  Chunk chunk(mesh, topology, {});
  StarShape shape = chunk.add(vertex);
  shape.first = static_cast<std::uint32_t>(others.size());
  others.insert(others.end(), chunk.others.begin(), chunk.others.end());
  return shape;
}

StarTable build_star_table(const Mesh& mesh, const Topology& topology, const Colouring& colouring, ThreadPool* pool) {
  StarTable table;
  const std::vector<Index>& visits = colouring.order;
  table.rank_of_vertex = rank_vertices(mesh.positions.size(), visits, table.vertex_of_rank);
  const std::vector<Index>& rank = table.rank_of_vertex;
  table.shapes = large_vector<StarShape>(visits.size() + 1);

  // In the mesh's order, in which a star's elements lie together in memory, and from there to each one's place.
  std::vector<std::vector<Index>> chunks((rank.size() + kStarsAtOnce - 1) / kStarsAtOnce);
  auto sizes = large_vector<std::uint32_t>(visits.size());
  for_chunks(pool, rank.size(), kStarsAtOnce, [&](std::size_t first, std::size_t last) {
    Chunk chunk(mesh, topology, rank);
    chunk.others.reserve((last - first) * 7);  // most stars are fans of six
    for (std::size_t v = first; v < last; ++v) {
      if (rank[v] >= visits.size()) continue;
      const StarShape shape = chunk.add(static_cast<Index>(v));
      table.shapes[rank[v]] = shape;
      sizes[rank[v]] = static_cast<std::uint32_t>(chunk.others.size()) - shape.first;
    }
    chunks[first / kStarsAtOnce] = std::move(chunk.others);
  });

  std::uint64_t end = 0;
  for (std::size_t i = 0; i < visits.size(); ++i) table.shapes[i].first = static_cast<std::uint32_t>(std::exchange(end, end + sizes[i]));
  if (end > std::numeric_limits<std::uint32_t>::max())
    throw UsageError("the mesh is too large to be smoothed: its stars have 2^32 corners or more");
  table.shapes.back().first = static_cast<std::uint32_t>(end);
  table.others = large_vector<Index>(end);
  for_chunks(pool, rank.size(), kStarsAtOnce, [&](std::size_t first, std::size_t last) {
    std::vector<Index>& chunk = chunks[first / kStarsAtOnce];
    auto from = chunk.cbegin();
    for (std::size_t v = first; v < last; ++v) {
      if (rank[v] >= visits.size()) continue;
      const auto next = from + sizes[rank[v]];
      std::copy(from, next, table.others.begin() + table.shapes[rank[v]].first);
      from = next;
    }
    chunk = {};
  });
  return table;
}

}  // namespace dmoscope
