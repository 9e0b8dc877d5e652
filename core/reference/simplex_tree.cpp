#include "core/reference/simplex_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dmoscope {

namespace {

constexpr double kRoundings = 16.0;   // rounding of a distance, in roundings of the largest coordinate
constexpr std::size_t kDeepest = 64;  // greatest depth of the stack: 2^32 simplices, halved at each step

double coordinate(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

}  // namespace

/// The nearest point of a triangle: the foot of the perpendicular if it lies inside, else the nearest of the sides' nearest points. The
/// foot is found twice, the second time from the first: in a needle, whose sides are nearly one line, the first is no better than rounding
/// times the needle's length over its width.
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

/// The point itself if it is inside of the tetrahedron, else the nearest point of its faces.
NearestIn<4> nearest_point(const std::array<Vec3, 4>& tetrahedron, Vec3 p) {
  const Vec3 a = tetrahedron[0], ab = tetrahedron[1] - a, ac = tetrahedron[2] - a, ad = tetrahedron[3] - a, ap = p - a;
  const double volume = dot(ab, cross(ac, ad));
  if (volume != 0.0) {
    const double wb = dot(ap, cross(ac, ad)) / volume, wc = dot(ab, cross(ap, ad)) / volume, wd = dot(ab, cross(ac, ap)) / volume;
    const double wa = 1.0 - wb - wc - wd;
    if (wa >= 0.0 && wb >= 0.0 && wc >= 0.0 && wd >= 0.0) return {{wa, wb, wc, wd}, 0.0};
  }
  NearestIn<4> best{{}, std::numeric_limits<double>::infinity()};
  for (std::size_t without = 0; without < 4; ++without) {
    const std::array<std::size_t, 3> face{(without + 1) % 4, (without + 2) % 4, (without + 3) % 4};
    const NearestIn<3> on_face = nearest_point(std::array{tetrahedron[face[0]], tetrahedron[face[1]], tetrahedron[face[2]]}, p);
    if (!(on_face.square < best.square)) continue;
    best = {{}, on_face.square};
    for (std::size_t k = 0; k < 3; ++k) best.weights[face[k]] = on_face.weights[k];
  }
  return best;
}

template <std::size_t N>
SimplexTree<N>::SimplexTree(std::vector<std::array<Vec3, N>> simplices, std::span<const Index> patch_of)
    : triangles_(std::move(simplices)), node_of_(triangles_.size()) {
  double largest = 0.0;
  for (const auto& triangle : triangles_)
    for (const Vec3 p : triangle) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  rounding_ = std::pow(kRoundings * std::numeric_limits<double>::epsilon() * largest, 2);
  std::vector<Index> order(triangles_.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index t) { return patch_of[t]; });
  nodes_.reserve(2 * order.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last < order.size() && patch_of[order[last]] == patch_of[order[first]]) ++last;
    build(std::span(order).subspan(first, last - first), kNoIndex);
    first = last;
  }
}

/// Splits at the median of the triangles' centres along the longest side of their bounding box; equal ones by number, so that the tree is
/// the same on every machine.
template <std::size_t N>
Index SimplexTree<N>::build(std::span<Index> order, Index up) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto centre = [this](Index t) {
    Vec3 sum = triangles_[t][0];
    for (std::size_t k = 1; k < N; ++k) sum = sum + triangles_[t][k];
    return sum;
  };
  Node node{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}, up, kNoIndex, kNoIndex};
  Vec3 low = node.low, high = node.high;  // bounding box of the centres
  for (const Index t : order) {
    for (const Vec3 corner : triangles_[t]) node.low = lower(node.low, corner), node.high = upper(node.high, corner);
    low = lower(low, centre(t)), high = upper(high, centre(t));
  }
  const auto number = static_cast<Index>(nodes_.size());
  nodes_.push_back(node);
  if (order.size() == 1) {
    nodes_[number].triangle = order[0];
    node_of_[order[0]] = number;
    return number;
  }
  const Vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t middle = order.size() / 2;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(middle), order.end(), [&](Index a, Index b) {
    const double ca = coordinate(centre(a), axis), cb = coordinate(centre(b), axis);
    return ca < cb || (ca == cb && a < b);
  });
  build(order.first(middle), number);
  nodes_[number].right = build(order.subspan(middle), number);
  return number;
}

template <std::size_t N>
double SimplexTree<N>::square_to(const Node& node, Vec3 p) {
  const auto beyond = [](double low, double at, double high) { return std::max(std::max(low - at, at - high), 0.0); };
  const double x = beyond(node.low.x, p.x, node.high.x), y = beyond(node.low.y, p.y, node.high.y), z = beyond(node.low.z, p.z, node.high.z);
  return x * x + y * y + z * z;
}

/// Goes upwards from the first triangle, and at each step through the other half: if that triangle is near, little is left to search.
template <std::size_t N>
auto SimplexTree<N>::nearest(Vec3 p, Index near) const -> Nearest {
  Nearest best{near, nearest_point(triangles_[near], p)};
  for (Index below = node_of_[near], here = nodes_[below].up; here != kNoIndex; below = here, here = nodes_[here].up)
    look_through(nodes_[here].right == below ? here + 1 : nodes_[here].right, p, best);
  return best;
}

/// Searches all simplices below a node.
template <std::size_t N>
void SimplexTree<N>::look_through(Index from, Vec3 p, Nearest& best) const {
  std::array<Index, kDeepest> waiting;
  std::size_t count = 0;
  waiting[count++] = from;
  while (count > 0) {
    const Index number = waiting[--count];
    const Node& node = nodes_[number];
    // Leaves a margin: both are rounded, and the result must not depend on where the search began.
    if (square_to(node, p) > 2.0 * (best.point.square + rounding_)) continue;
    if (node.right == kNoIndex) {
      const NearestIn<N> found = nearest_point(triangles_[node.triangle], p);
      const bool equal = found.square == best.point.square;
      if (found.square < best.point.square || (equal && node.triangle < best.triangle)) best = {node.triangle, found};
      continue;
    }
    const bool left_first = square_to(nodes_[number + 1], p) < square_to(nodes_[node.right], p);
    waiting[count++] = left_first ? node.right : number + 1;
    waiting[count++] = left_first ? number + 1 : node.right;
  }
}

template class SimplexTree<3>;
template class SimplexTree<4>;

}  // namespace dmoscope
