#include "core/mesh/colouring.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/base/box.h"
#include "core/base/memory.h"
#include "core/base/thread_pool.h"
#include "core/mesh/hilbert_curve.h"
#include "core/mesh/random.h"

namespace dmoscope {

namespace {

/// A vertex with its sort key.
struct KeyedVertex {
  std::uint32_t key;
  Index vertex;
};

constexpr std::size_t kStretch = 4096;  // vertices in a stretch: some 200 KB with their rings

/// Sorts vertices, at most kStretch, by the size of their stars, stably.
void sort_by_star(std::span<Index> vertices, const Topology& topology) {
  constexpr std::size_t kLargest = 63;  // stars larger than this count as this large
  std::array<std::uint8_t, kStretch> star;
  std::array<Index, kStretch> unsorted;
  std::array<std::size_t, kLargest + 2> start{};
  std::ranges::copy(vertices, unsorted.begin());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    star[i] = static_cast<std::uint8_t>(std::min(topology.star(vertices[i]).size(), kLargest));
    ++start[star[i] + std::size_t{1}];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[start[star[i]]++] = unsorted[i];
}

/// Place of a vertex along the Z-order curve over the bounding box of all vertices, 0 to 2^32 - 1.
class Curve {
 public:
  /// Fits the curve to the vertices. `plane`: null for a curve of space.
  Curve(const Mesh& mesh, const Plane* plane, std::span<const Index> vertices, ThreadPool* pool) : mesh_(mesh), plane_(plane) {
    constexpr std::size_t kGrain = 65536;
    std::vector<PointBox> parts((vertices.size() + kGrain - 1) / kGrain);
    for_chunks(pool, vertices.size(), kGrain, [&](std::size_t first, std::size_t last) {
      PointBox box;
      for (const Index v : vertices.subspan(first, last - first)) box.add(place(v));
      parts[first / kGrain] = box;
    });
    PointBox box;
    for (const PointBox& part : parts) box.add(part.low), box.add(part.high);
    low_ = box.low;
    const double size = std::max({box.high.x - low_.x, box.high.y - low_.y, box.high.z - low_.z});
    scale_ = size > 0.0 ? (plane != nullptr ? 65535.0 : 1023.0) / size : 0.0;
  }
  [[nodiscard]] std::uint32_t key(Index vertex) const {
    const Vec3 p = place(vertex) - low_;
    if (plane_ != nullptr) return static_cast<std::uint32_t>(spread_by_two(cell(p.x)) | spread_by_two(cell(p.y)) << 1U);
    return static_cast<std::uint32_t>(spread_by_three(cell(p.x)) | spread_by_three(cell(p.y)) << 1U | spread_by_three(cell(p.z)) << 2U);
  }

 private:
  /// Coordinates of a vertex; with a plane those in it, and z = 0.
  [[nodiscard]] Vec3 place(Index vertex) const {
    const Vec3& p = mesh_.positions[vertex];
    if (plane_ == nullptr) return p;
    const Vec2<double> flat = plane_->project(p);
    return {flat.x, flat.y, 0.0};
  }
  [[nodiscard]] std::uint32_t cell(double offset) const {
    const double value = offset * scale_;
    return value >= 0.0 && value <= 65535.0 ? static_cast<std::uint32_t>(value) : 0U;
  }
  const Mesh& mesh_;
  const Plane* plane_;
  Vec3 low_;
  double scale_ = 0.0;
};

/// A greedy colouring. Its colours depend on one another along the whole mesh, so one thread finds them; many arrange the classes.
class Greedy {
 public:
  Greedy(const Mesh& mesh, const Topology& topology, std::span<const Index> followers)
      : mesh_(mesh), topology_(topology), followers_(followers), colour_(mesh.positions.size(), kNone) {}

  void colour(std::span<const Index> vertices) {
    for (const Index v : vertices) {
      colour_[v] = lowest_free(v);
      if (const Index follower = follower_of(v); follower != kNoIndex) colour_[follower] = colour_[v];
    }
  }

  [[nodiscard]] Colouring classes(std::span<const Index> vertices, ThreadPool* pool) const {
    const std::size_t parts = (vertices.size() + kPart - 1) / kPart;
    std::vector<std::vector<Index>> next(parts);  // by colour, the number of vertices in a part, then the place of its first one
    for_chunks(pool, vertices.size(), kPart, [&](std::size_t first, std::size_t last) {
      auto& count = next[first / kPart];
      for (const Index v : vertices.subspan(first, last - first)) {
        if (count.size() <= colour_[v]) count.resize(colour_[v] + std::size_t{1});
        ++count[colour_[v]];
      }
    });
    std::size_t colours = 0;
    for (const auto& count : next) colours = std::max(colours, count.size());
    Colouring result;
    result.class_offsets.assign(colours + 1, 0);
    Index sum = 0;
    for (std::size_t c = 0; c < colours; ++c) {
      result.class_offsets[c] = sum;
      for (auto& count : next)
        if (c < count.size()) sum += std::exchange(count[c], sum);
    }
    result.class_offsets[colours] = sum;
    result.order = large_vector<Index>(vertices.size());
    for_chunks(pool, vertices.size(), kPart, [&](std::size_t first, std::size_t last) {
      auto& place = next[first / kPart];
      for (const Index v : vertices.subspan(first, last - first)) result.order[place[colour_[v]]++] = v;
    });
    return result;
  }

 private:
  /// A colour's number: more than 65,536 would need more corners than 32 bits can count.
  using Colour = std::uint16_t;
  static constexpr Colour kNone = 0xffff;
  static constexpr std::size_t kPart = 32768;  // vertices in a part

  [[nodiscard]] Index follower_of(Index v) const { return followers_.empty() ? kNoIndex : followers_[v]; }

  /// Bits of the colours, among the 64 from `base` on, of the vertices that share an element with v.
  [[nodiscard]] std::uint64_t colours_around(Index v, unsigned base) const {
    std::uint64_t taken = 0;
    for (const Incidence& incidence : topology_.star(v))
      for (const Index other : mesh_.elements.corners(incidence.element)) {
        const unsigned above = colour_[other] - base;  // wraps to a huge number if the colour is below
        if (above < 64) taken |= std::uint64_t{1} << above;
      }
    return taken;
  }
  /// The lowest colour that no vertex has that shares an element with v, or with its follower.
  [[nodiscard]] Colour lowest_free(Index v) const {
    const Index follower = follower_of(v);
    for (unsigned base = 0;; base += 64) {
      std::uint64_t taken = colours_around(v, base);
      if (follower != kNoIndex) taken |= colours_around(follower, base);
      if (~taken != 0) return static_cast<Colour>(base + static_cast<unsigned>(std::countr_one(taken)));
    }
  }

  const Mesh& mesh_;
  const Topology& topology_;
  std::span<const Index> followers_;
  std::vector<Colour> colour_;
};

/// Sorts the members of every class by their keys, stably: by the highest bits into buckets, and each bucket by the rest.
void sort_classes(Colouring& colouring, const Curve& curve, ThreadPool* pool) {
  constexpr unsigned kBits = 8;
  constexpr std::size_t kGrain = 65536;
  const std::vector<Index>& offsets = colouring.class_offsets;
  const std::size_t count = colouring.order.size(), buckets = std::size_t{colouring.class_count()} << kBits;
  auto items = large_vector<KeyedVertex>(count), sorted = large_vector<KeyedVertex>(count);
  std::vector<std::vector<Index>> next((count + kGrain - 1) / kGrain);  // by bucket, a chunk's number of members, then its first place
  const auto for_buckets = [&](std::size_t first, std::size_t last, const auto& take) {
    auto c = static_cast<std::size_t>(std::ranges::upper_bound(offsets, first) - offsets.begin()) - 1;
    for (std::size_t i = first; i < last; ++i) {
      while (i >= offsets[c + 1]) ++c;
      take(i, c << kBits | items[i].key >> (32 - kBits));
    }
  };
  for_chunks(pool, count, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) items[i] = {curve.key(colouring.order[i]), colouring.order[i]};
    auto& mine = next[first / kGrain];
    mine.assign(buckets, 0);
    for_buckets(first, last, [&](std::size_t, std::size_t bucket) { ++mine[bucket]; });
  });
  std::vector<Index> begins(buckets + 1);
  Index sum = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    begins[bucket] = sum;
    for (auto& chunk : next) sum += std::exchange(chunk[bucket], sum);
  }
  begins[buckets] = sum;
  for_chunks(pool, count, kGrain, [&](std::size_t first, std::size_t last) {
    auto& mine = next[first / kGrain];
    for_buckets(first, last, [&](std::size_t i, std::size_t bucket) { sorted[mine[bucket]++] = items[i]; });
  });
  for_chunks(pool, buckets, 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t bucket = first; bucket < last; ++bucket)
      std::stable_sort(sorted.begin() + begins[bucket], sorted.begin() + begins[bucket + 1],
                       [](const KeyedVertex& a, const KeyedVertex& b) { return a.key < b.key; });
    for (std::size_t i = begins[first]; i < begins[last]; ++i) colouring.order[i] = sorted[i].vertex;
  });
}

}  // namespace

Colouring colour_vertices(const Mesh& mesh, const Topology& topology, std::span<const Index> free_vertices, ThreadPool* pool,
                          std::span<const Index> followers) {
  Greedy greedy(mesh, topology, followers);
  greedy.colour(free_vertices);
  return greedy.classes(free_vertices, pool);
}

void arrange_classes(Colouring& colouring, const Mesh& mesh, const Plane* plane, const Topology& topology, ThreadPool* pool) {
  sort_classes(colouring, Curve(mesh, plane, colouring.order, pool), pool);
  std::vector<std::span<Index>> stretches;
  for (Index c = 0; c < colouring.class_count(); ++c)
    for (std::span<Index> rest(colouring.order.data() + colouring.class_offsets[c], colouring.members(c).size()); !rest.empty();) {
      stretches.push_back(rest.first(std::min(kStretch, rest.size())));
      rest = rest.subspan(stretches.back().size());
    }
  for_chunks(pool, stretches.size(), 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) sort_by_star(stretches[i], topology);
  });
}

std::vector<Index> shuffled(std::span<const Index> vertices, std::uint64_t seed) {
  std::vector<Index> order(vertices.begin(), vertices.end());
  Random random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);  // Fisher-Yates shuffle
  return order;
}

}  // namespace dmoscope
