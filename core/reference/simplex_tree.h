#pragma once
// Trees of bounding boxes around triangles or tetrahedra, to find the nearest one.

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// The nearest point of a triangle (3 corners) or tetrahedron (4), as weights of its corners.
template <std::size_t N>
struct NearestIn {
  std::array<double, N> weights{};
  double square = 0.0;  // square of the distance; 0 in a tetrahedron
};
using NearestPoint = NearestIn<3>;
[[nodiscard]] NearestIn<3> nearest_point(const std::array<Vec3, 3>& triangle, Vec3 p);
[[nodiscard]] NearestIn<4> nearest_point(const std::array<Vec3, 4>& tetrahedron, Vec3 p);

/// A set of triangles or tetrahedra, with a tree for each patch.
template <std::size_t N>
class SimplexTree {
 public:
  SimplexTree() = default;
  /// Builds the trees. `patch_of`: patch of each simplex.
  SimplexTree(std::vector<std::array<Vec3, N>> simplices, std::span<const Index> patch_of);

  struct Nearest {
    Index triangle = kNoIndex;  // triangle or tetrahedron
    NearestIn<N> point;
  };
  /// The nearest simplex of a patch; of several the first. `near`: any of them to begin with; the nearer, the faster.
  [[nodiscard]] Nearest nearest(Vec3 p, Index near) const;
  /// Calls visit(a, b) for each pair of simplices of the first patch whose boxes overlap.
  template <class Visit>
  void for_overlapping(Visit visit) const;

 private:
  struct Node {
    Vec3 low, high;
    Index up;        // parent node; kNoIndex: the root of a patch's tree
    Index right;     // second half; the first half is the next node; kNoIndex: a single simplex
    Index triangle;  // the simplex of a leaf
  };
  Index build(std::span<Index> order, Index up);
  void look_through(Index from, Vec3 p, Nearest& best) const;
  [[nodiscard]] static double square_to(const Node& node, Vec3 p);

  std::vector<std::array<Vec3, N>> triangles_;
  std::vector<Node> nodes_;
  std::vector<Index> node_of_;  // leaf of each simplex
  double rounding_ = 0.0;       // rounding of a distance, squared
};
using FacetTree = SimplexTree<3>;

template <std::size_t N>
template <class Visit>
void SimplexTree<N>::for_overlapping(Visit visit) const {
  std::vector<std::array<Index, 2>> waiting;
  if (!nodes_.empty()) waiting.push_back({0, 0});
  const auto is_one = [this](Index n) { return nodes_[n].right == kNoIndex; };
  while (!waiting.empty()) {
    auto [a, b] = waiting.back();
    waiting.pop_back();
    const Node &one = nodes_[a], &other = nodes_[b];
    if (a == b) {
      if (!is_one(a)) waiting.insert(waiting.end(), {{a + 1, a + 1}, {one.right, one.right}, {a + 1, one.right}});
      continue;
    }
    if (one.low.x > other.high.x || other.low.x > one.high.x || one.low.y > other.high.y || other.low.y > one.high.y ||
        one.low.z > other.high.z || other.low.z > one.high.z)
      continue;
    if (is_one(a) && is_one(b)) {
      visit(one.triangle, other.triangle);
      continue;
    }
    const Vec3 wide = one.high - one.low, width = other.high - other.low;
    if (is_one(a) || (!is_one(b) && dot(width, width) > dot(wide, wide))) std::swap(a, b);
    waiting.insert(waiting.end(), {{a + 1, b}, {nodes_[a].right, b}});
  }
}

}  // namespace dmoscope
