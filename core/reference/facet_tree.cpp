#include "core/reference/facet_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dmoscope {

namespace {

constexpr std::size_t kLeaf = 1;
constexpr double kRoundings = 16.0;   // of the largest coordinate, in a distance
constexpr std::size_t kDeepest = 64;  // halves of 2^32 triangles

double coordinate(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

}  // namespace

/// The nearest of the foot of the perpendicular, where it lies inside, and the nearest points of the sides. The foot is found twice, the
/// second time from the first: of a needle, whose sides are nearly one line, the first is no better than rounding times the needle's
/// length over its width.
NearestPoint nearest_point(const std::array<Vec3, 3>& triangle, Vec3 p) {
  const Vec3 a = triangle[0], ab = triangle[1] - a, ac = triangle[2] - a, ap = p - a;
  const Vec3 normal = cross(ab, ac);
  const double area = dot(normal, normal);
  NearestPoint best{{}, std::numeric_limits<double>::infinity()};
  const auto take = [&](double wb, double wc) {
    const Vec3 way = ap - (wb * ab + wc * ac);
    const double square = dot(way, way);
    if (square < best.square) best = {{1.0 - wb - wc, wb, wc}, square};
  };
  if (area > 0.0) {
    double wb = dot(cross(ap, ac), normal) / area, wc = dot(cross(ab, ap), normal) / area;
    const Vec3 rest = ap - (wb * ab + wc * ac);
    wb += dot(cross(rest, ac), normal) / area;
    wc += dot(cross(ab, rest), normal) / area;
    if (wb >= 0.0 && wc >= 0.0 && wb + wc <= 1.0) take(wb, wc);
  }
  const auto along = [](Vec3 way, Vec3 from) {
    const double square = dot(way, way);
    return square > 0.0 ? std::clamp(dot(from, way) / square, 0.0, 1.0) : 0.0;
  };
  const double on_bc = along(ac - ab, ap - ab);
  take(along(ab, ap), 0.0);
  take(1.0 - on_bc, on_bc);
  take(0.0, along(ac, ap));
  return best;
}

FacetTree::FacetTree(std::vector<std::array<Vec3, 3>> triangles, std::span<const Index> patch_of, Index patches)
    : triangles_(std::move(triangles)), order_(triangles_.size()), roots_(patches) {
  double largest = 0.0;
  for (const auto& triangle : triangles_)
    for (const Vec3 p : triangle) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  rounding_ = std::pow(kRoundings * std::numeric_limits<double>::epsilon() * largest, 2);
  std::iota(order_.begin(), order_.end(), Index{0});
  std::ranges::stable_sort(order_, {}, [&](Index t) { return patch_of[t]; });
  for (std::size_t first = 0; first < order_.size();) {
    std::size_t last = first;
    while (last < order_.size() && patch_of[order_[last]] == patch_of[order_[first]]) ++last;
    const Index patch = patch_of[order_[first]];
    roots_[patch] = build(first, last);
    first = last;
  }
}

/// Splits in the middle of the triangles along the longest side of the box of their centres; among equals by number, so that the tree is
/// the same on every machine.
Index FacetTree::build(std::size_t first, std::size_t last) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto centre = [this](Index t) { return triangles_[t][0] + triangles_[t][1] + triangles_[t][2]; };
  Node node{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}, kNoIndex, kNoIndex,
            static_cast<Index>(first),         static_cast<Index>(last - first)};
  Vec3 low = node.low, high = node.high;  // of the centres
  for (std::size_t i = first; i < last; ++i) {
    for (const Vec3 corner : triangles_[order_[i]]) node.low = lower(node.low, corner), node.high = upper(node.high, corner);
    low = lower(low, centre(order_[i])), high = upper(high, centre(order_[i]));
  }
  const auto number = static_cast<Index>(nodes_.size());
  nodes_.push_back(node);
  if (last - first <= kLeaf) return number;
  const Vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [&](Index a, Index b) {
    const double ca = coordinate(centre(a), axis), cb = coordinate(centre(b), axis);
    return ca < cb || (ca == cb && a < b);
  });
  const Index left = build(first, middle), right = build(middle, last);
  nodes_[number].left = left;
  nodes_[number].right = right;
  return number;
}

double FacetTree::square_to(const Node& node, Vec3 p) {
  const double x = std::max({node.low.x - p.x, 0.0, p.x - node.high.x}), y = std::max({node.low.y - p.y, 0.0, p.y - node.high.y}),
               z = std::max({node.low.z - p.z, 0.0, p.z - node.high.z});
  return x * x + y * y + z * z;
}

FacetTree::Nearest FacetTree::nearest(Index patch, Vec3 p, Index near) const {
  Nearest best{near, nearest_point(triangles_[near], p)};
  std::array<Index, kDeepest> waiting;
  std::size_t count = 0;
  waiting[count++] = roots_[patch];
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    // Both are rounded, and the one found must not depend on where the search began.
    if (square_to(node, p) > 2.0 * (best.point.square + rounding_)) continue;
    if (node.left == kNoIndex) {
      for (Index i = node.first; i < node.first + node.count; ++i) {
        const Index t = order_[i];
        if (t == near) continue;
        const NearestPoint found = nearest_point(triangles_[t], p);
        const bool equal = found.square == best.point.square;
        if (found.square < best.point.square || (equal && t < best.triangle)) best = {t, found};
      }
      continue;
    }
    const bool left_first = square_to(nodes_[node.left], p) < square_to(nodes_[node.right], p);
    waiting[count++] = left_first ? node.right : node.left;
    waiting[count++] = left_first ? node.left : node.right;
  }
  return best;
}

}  // namespace dmoscope
