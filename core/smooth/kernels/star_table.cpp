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

constexpr std::size_t kStarsAtOnce = 8192;  // vertices in a chunk

/// Greatest number of other corners that a star has for each of its elements.
constexpr std::size_t kOthersAnElement = 3;

/// Stars of one chunk of vertices; `first` of its shapes counts from the chunk's own beginning. No ranks: vertices stand for them.
class Chunk {
 public:
  /// `others`: memory for their other corners, kOthersAnElement for each element of each star.
  Chunk(const Mesh& mesh, const Topology& topology, std::span<const Index> rank, Index* others)
      : mesh_(mesh), topology_(topology), rank_(rank), others_(others) {}

  StarShape add(Index vertex) {
    const auto star = topology_.star(vertex);
    StarShape shape;
    shape.first = size_;
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
      put(pairs_);
      put(triples_);
      if (triangles > kMaxTriangles || quadrilaterals > kMaxQuadrilaterals) return shape;
      shape.kind = StarShape::Kind::General;
    }
    shape.triangles = static_cast<std::uint8_t>(triangles);
    shape.quadrilaterals = static_cast<std::uint8_t>(quadrilaterals);
    return shape;
  }

  [[nodiscard]] std::uint32_t size() const noexcept { return size_; }

 private:
  void put(std::span<const Index> corners) {
    std::ranges::copy(corners, others_ + size_);
    size_ += static_cast<std::uint32_t>(corners.size());
  }
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
    put(std::span(ring).first(count));
    return true;
  }

  const Mesh& mesh_;
  const Topology& topology_;
  std::span<const Index> rank_;
  Index* others_;
  std::uint32_t size_ = 0;
  std::vector<Index> pairs_, triples_;
};

/// Ranks of all vertices; fills the inverse of their table.
std::vector<Index> rank_vertices(std::size_t count, std::span<const Index> visits, std::vector<Index>& vertex_of_rank, ThreadPool* pool) {
  auto rank = large_vector<Index>(count, kNoIndex);
  vertex_of_rank = large_vector<Index>(count);
  for_chunks(pool, visits.size(), kStarsAtOnce, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      vertex_of_rank[i] = visits[i];
      rank[visits[i]] = static_cast<Index>(i);
    }
  });
  auto next = static_cast<Index>(visits.size());
  for (Index v = 0; v < count; ++v) {
    if (rank[v] != kNoIndex) continue;
    vertex_of_rank[next] = v;
    rank[v] = next++;
  }
  return rank;
}

}  // namespace

StarShape star_shape(const Mesh& mesh, const Topology& topology, Index vertex, std::vector<Index>& others) {
  const std::size_t before = others.size();
  others.resize(before + kOthersAnElement * topology.star(vertex).size());
  Chunk chunk(mesh, topology, {}, others.data() + before);
  StarShape shape = chunk.add(vertex);
  shape.first = static_cast<std::uint32_t>(before);
  others.resize(before + chunk.size());
  return shape;
}

StarTable build_star_table(const Mesh& mesh, const Topology& topology, const Colouring& colouring, ThreadPool* pool) {
  StarTable table;
  const std::vector<Index>& visits = colouring.order;
  table.rank_of_vertex = rank_vertices(mesh.positions.size(), visits, table.vertex_of_rank, pool);
  const std::vector<Index>& rank = table.rank_of_vertex;
  table.shapes = large_vector<StarShape>(visits.size() + 1);

  // Makes the stars in the mesh's order, in which a star's elements lie together in memory, and moves them from there to each one's place.
  // One piece of memory, of which every chunk has its part: to ask the system for many takes longer than to fill them.
  const std::size_t room = kOthersAnElement * topology.incidences().size();
  const auto scratch = std::make_unique_for_overwrite<Index[]>(room);
  const auto others_from = [&](std::size_t first) { return scratch.get() + kOthersAnElement * topology.star_offsets()[first]; };
  auto sizes = large_vector<std::uint32_t>(visits.size());
  for_chunks(pool, rank.size(), kStarsAtOnce, [&](std::size_t first, std::size_t last) {
    Chunk chunk(mesh, topology, rank, others_from(first));
    for (std::size_t v = first; v < last; ++v) {
      if (rank[v] >= visits.size()) continue;
      const StarShape shape = chunk.add(static_cast<Index>(v));
      table.shapes[rank[v]] = shape;
      sizes[rank[v]] = chunk.size() - shape.first;
    }
  });

  std::uint64_t end = 0;
  for (std::size_t i = 0; i < visits.size(); ++i) table.shapes[i].first = static_cast<std::uint32_t>(std::exchange(end, end + sizes[i]));
  if (end > std::numeric_limits<std::uint32_t>::max())
    throw UsageError("the mesh is too large to be smoothed: its stars have 2^32 corners or more");
  table.shapes.back().first = static_cast<std::uint32_t>(end);
  table.others = large_vector<Index>(end);
  for_chunks(pool, rank.size(), kStarsAtOnce, [&](std::size_t first, std::size_t last) {
    const Index* from = others_from(first);
    for (std::size_t v = first; v < last; ++v) {
      if (rank[v] >= visits.size()) continue;
      const Index* next = from + sizes[rank[v]];
      std::copy(from, next, table.others.begin() + table.shapes[rank[v]].first);
      from = next;
    }
  });
  return table;
}

}  // namespace dmoscope
