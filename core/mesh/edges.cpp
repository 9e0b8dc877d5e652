#include "core/mesh/edges.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace dmoscope {
namespace {

/// Calls visit(from, to, side, element) for every side of every planar element with two distinct ends.
template <class Visit>
void for_each_side(const Mesh& mesh, Visit visit) {
  const ElementTable& elements = mesh.elements;
  for (Index e = 0; e < elements.size(); ++e) {
    if (info(elements.kind(e)).dimension != 2) continue;
    const auto corners = elements.corners(e);
    const Index first = elements.offsets()[e];
    for (Index i = 0; i < corners.size(); ++i) {
      const Index from = corners[i];
      const Index to = corners[i + 1 < corners.size() ? i + 1 : 0];
      if (from != to) visit(from, to, first + i, e);
    }
  }
}

/// Disjoint sets with path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// True when the two were apart.
  bool join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace

EdgeTable::EdgeTable(const Mesh& mesh) {
  const ElementTable& elements = mesh.elements;
  if (elements.size() > 0) {
    const Index corners = info(elements.kind(0)).corners;
    const bool uniform = std::ranges::all_of(elements.kinds(), [&](ElementKind k) { return info(k).corners == corners; });
    if (uniform) uniform_ = corners;
  }
  if (uniform_ == 0) {
    owner_.resize(elements.all_corners().size());
    for (Index e = 0; e < elements.size(); ++e) {
      std::fill(owner_.begin() + elements.offsets()[e], owner_.begin() + elements.offsets()[e + 1], e);
    }
  }
  collect(mesh);
}

void EdgeTable::collect(const Mesh& mesh) {
  // Counting sort by the lower vertex, then a small sort by (higher vertex, side) inside each bucket.
  std::vector<std::uint32_t> bucket(mesh.positions.size() + 2, 0);
  for_each_side(mesh, [&](Index from, Index to, Index, Index) { ++bucket[std::min(from, to) + 2]; });
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<std::uint64_t> keys(bucket.back());
  for_each_side(mesh, [&](Index from, Index to, Index side, Index) {
    keys[bucket[std::min(from, to) + 1]++] = (static_cast<std::uint64_t>(std::max(from, to)) << 32U) | side;
  });
  sides_.reserve(keys.size());
  edges_.reserve(keys.size() / 2 + keys.size() / 16);
  first_.reserve(edges_.capacity() + 1);
  for (Index low = 0; low < mesh.vertex_count(); ++low) {
    const std::span bucket_keys(keys.data() + bucket[low], keys.data() + bucket[low + 1]);
    std::ranges::sort(bucket_keys);
    Index previous = kNoIndex;
    for (const std::uint64_t key : bucket_keys) {
      const auto high = static_cast<Index>(key >> 32U);
      if (high != previous) {
        edges_.push_back({low, high});
        first_.push_back(static_cast<Index>(sides_.size()));
        previous = high;
      }
      sides_.push_back(static_cast<Index>(key & 0xffffffffU));
    }
  }
  first_.push_back(static_cast<Index>(sides_.size()));
}

namespace {

/// Boundary edges in a row, with what is needed to follow them through a vertex.
class BoundaryCurves {
 public:
  BoundaryCurves(const Mesh& mesh, const EdgeTable& edges) : edges_(edges), degree_(mesh.positions.size(), 0) {
    for (Index i = 0; i < edges.size(); ++i) {
      if (edges.sides(i).size() != 1) continue;
      boundary_.push_back(i);
      for (const Index v : {edges.edge(i).low, edges.edge(i).high}) degree_[v] = std::min<std::uint8_t>(3, degree_[v] + 1U);
    }
  }

  [[nodiscard]] Index count(const Mesh& mesh) {
    DisjointSets fans = split_fans(mesh);
    // Curves are the connected sets of boundary edges: count = edges - successful joins.
    DisjointSets curves(boundary_.size());
    std::unordered_map<std::uint64_t, Index> seen;
    Index loops = static_cast<Index>(boundary_.size());
    for (Index k = 0; k < boundary_.size(); ++k) {
      const Edge edge = edges_.edge(boundary_[k]);
      const Index element = edges_.element(edges_.sides(boundary_[k]).front());
      for (const Index v : {edge.low, edge.high}) {
        std::uint64_t key = static_cast<std::uint64_t>(v) << 32U;
        if (degree_[v] > 2) key |= fans.find(corner_.at(corner_key(v, element))) + 1U;
        const auto [place, fresh] = seen.try_emplace(key, k);
        if (!fresh && curves.join(place->second, k)) --loops;
      }
    }
    return loops;
  }

 private:
  static std::uint64_t corner_key(Index vertex, Index element) { return (static_cast<std::uint64_t>(vertex) << 32U) | element; }

  /// At vertices where more than two boundary edges meet: which elements hang together across edges through the vertex.
  DisjointSets split_fans(const Mesh& mesh) {
    for_each_side(mesh, [&](Index from, Index to, Index, Index e) {
      for (const Index v : {from, to}) {
        if (degree_[v] > 2) corner_.try_emplace(corner_key(v, e), static_cast<Index>(corner_.size()));
      }
    });
    DisjointSets fans(corner_.size());
    if (corner_.empty()) return fans;
    for (Index i = 0; i < edges_.size(); ++i) {
      const auto sides = edges_.sides(i);
      for (const Index v : {edges_.edge(i).low, edges_.edge(i).high}) {
        if (sides.size() != 2 || degree_[v] <= 2) continue;
        fans.join(corner_.at(corner_key(v, edges_.element(sides[0]))), corner_.at(corner_key(v, edges_.element(sides[1]))));
      }
    }
    return fans;
  }

  const EdgeTable& edges_;
  std::vector<std::uint8_t> degree_;  // boundary edges at each vertex, 3 standing for more than two
  std::vector<Index> boundary_;
  std::unordered_map<std::uint64_t, Index> corner_;
};

}  // namespace

Index count_boundary_loops(const Mesh& mesh, const EdgeTable& edges) { return BoundaryCurves(mesh, edges).count(mesh); }

}  // namespace dmoscope
