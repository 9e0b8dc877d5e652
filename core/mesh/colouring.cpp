#include "core/mesh/colouring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/radix_sort.h"
#include "core/base/thread_pool.h"
#include "core/mesh/random.h"

namespace dmoscope {

namespace {

/// Every second bit of the result is one of the 16 of `x`.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 8U) & 0x00ff00ffU;
  x = (x | x << 4U) & 0x0f0f0f0fU;
  x = (x | x << 2U) & 0x33333333U;
  return (x | x << 1U) & 0x55555555U;
}

/// A vertex with what it is sorted by.
struct KeyedVertex {
  std::uint32_t key;
  Index vertex;
};

constexpr std::size_t kStretch = 4096;  // vertices: some 200 KB with their rings

/// The items' vertices by the size of their stars, stably.
void sort_by_star(std::span<const KeyedVertex> items, const Topology& topology, std::span<Index> sorted) {
  constexpr std::size_t kLargest = 63;  // larger ones count as this
  std::array<std::uint8_t, kStretch> star;
  std::array<std::size_t, kLargest + 2> start{};
  for (std::size_t i = 0; i < items.size(); ++i) {
    star[i] = static_cast<std::uint8_t>(std::min(topology.star(items[i].vertex).size(), kLargest));
    ++start[star[i] + std::size_t{1}];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (std::size_t i = 0; i < items.size(); ++i) sorted[start[star[i]]++] = items[i].vertex;
}

/// Every third bit of the result is one of the 10 of `x`.
std::uint32_t spread_bits_by_three(std::uint32_t x) {
  x = (x | x << 16U) & 0x030000ffU;
  x = (x | x << 8U) & 0x0300f00fU;
  x = (x | x << 4U) & 0x030c30c3U;
  return (x | x << 2U) & 0x09249249U;
}

/// Where vertices lie along the Z-order curve over the box of all of them, 0 to 2^32 - 1.
class Curve {
 public:
  /// `plane`: null for a curve of space.
  Curve(const Mesh& mesh, const Plane* plane, std::span<const Index> vertices, ThreadPool* pool) : mesh_(mesh), plane_(plane) {
    struct Box {
      Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
      void add(Vec3 p, Vec3 q) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
      }
    };
    constexpr std::size_t kGrain = 65536;
    std::vector<Box> parts((vertices.size() + kGrain - 1) / kGrain);
    for_chunks(pool, vertices.size(), kGrain, [&](std::size_t first, std::size_t last) {
      Box box;
      for (const Index v : vertices.subspan(first, last - first)) {
        const Vec3 p = place(v);
        box.add(p, p);
      }
      parts[first / kGrain] = box;
    });
    Box box;
    for (const Box& part : parts) box.add(part.low, part.high);
    low_ = box.low;
    const double size = std::max({box.high.x - low_.x, box.high.y - low_.y, box.high.z - low_.z});
    scale_ = size > 0.0 ? (plane != nullptr ? 65535.0 : 1023.0) / size : 0.0;
  }
  [[nodiscard]] std::uint32_t key(Index vertex) const {
    const Vec3 p = place(vertex) - low_;
    if (plane_ != nullptr) return spread_bits(cell(p.x)) | spread_bits(cell(p.y)) << 1U;
    return spread_bits_by_three(cell(p.x)) | spread_bits_by_three(cell(p.y)) << 1U | spread_bits_by_three(cell(p.z)) << 2U;
  }

 private:
  /// In the plane: with z = 0.
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

}  // namespace

Colouring colour_vertices(const Mesh& mesh, const Topology& topology, std::span<const Index> free_vertices) {
  std::vector<Index> colour(mesh.positions.size(), kNoIndex);
  std::vector<Index> taken_by;  // taken_by[c] == v: colour c is taken near v
  std::vector<Index> class_size;
  for (const Index v : free_vertices) {
    for (const Incidence& incidence : topology.star(v)) {
      for (const Index other : mesh.elements.corners(incidence.element)) {
        if (colour[other] != kNoIndex) taken_by[colour[other]] = v;
      }
    }
    Index c = 0;
    while (c < taken_by.size() && taken_by[c] == v) ++c;
    if (c == taken_by.size()) {
      taken_by.push_back(kNoIndex);
      class_size.push_back(0);
    }
    colour[v] = c;
    ++class_size[c];
  }

  Colouring result;
  result.class_offsets.resize(class_size.size() + 1, 0);
  std::partial_sum(class_size.begin(), class_size.end(), result.class_offsets.begin() + 1);
  result.order.resize(free_vertices.size());
  std::vector<Index> next(result.class_offsets.begin(), result.class_offsets.end() - 1);
  for (const Index v : free_vertices) result.order[next[colour[v]]++] = v;
  return result;
}

void arrange_classes(Colouring& colouring, const Mesh& mesh, const Plane* plane, const Topology& topology, ThreadPool* pool) {
  const Curve curve(mesh, plane, colouring.order, pool);
  for_chunks(pool, colouring.class_count(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      const std::span<Index> members(colouring.order.data() + colouring.class_offsets[c], colouring.members(static_cast<Index>(c)).size());
      std::vector<KeyedVertex> items(members.size());
      for (std::size_t i = 0; i < members.size(); ++i) items[i] = {curve.key(members[i]), members[i]};
      radix_sort(items, 32, [](const KeyedVertex& item) { return item.key; });
      for (std::size_t begin = 0; begin < items.size(); begin += kStretch)
        sort_by_star(std::span(items).subspan(begin, std::min(kStretch, items.size() - begin)), topology, members.subspan(begin));
    }
  });
}

std::vector<Index> shuffled(std::span<const Index> vertices, std::uint64_t seed) {
  std::vector<Index> order(vertices.begin(), vertices.end());
  Random random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);  // Fisher-Yates
  return order;
}

}  // namespace dmoscope
