#pragma once
// Boxes around boxes around triangles: finds the nearest one.

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// The nearest point of a triangle, as weights of its corners.
struct NearestPoint {
  std::array<double, 3> weights{};
  double square = 0.0;  // of the distance
};
[[nodiscard]] NearestPoint nearest_point(const std::array<Vec3, 3>& triangle, Vec3 p);

/// A tree for each patch of a set of triangles.
class FacetTree {
 public:
  FacetTree() = default;
  /// `patch_of`: by triangle.
  FacetTree(std::vector<std::array<Vec3, 3>> triangles, std::span<const Index> patch_of);

  struct Nearest {
    Index triangle = kNoIndex;
    NearestPoint point;
  };
  /// Of the triangles of a patch the nearest; of equals the first. `near`: one of them to begin with, any; the nearer, the faster.
  [[nodiscard]] Nearest nearest(Vec3 p, Index near) const;
  /// visit(a, b) for each pair of triangles of the first patch whose boxes overlap.
  template <class Visit>
  void for_overlapping(Visit visit) const;

 private:
  struct Node {
    Vec3 low, high;
    Index up;        // kNoIndex: it is a patch's whole tree
    Index right;     // the second half; the first half is the next node; kNoIndex: it is one triangle
    Index triangle;  // of one
  };
  Index build(std::span<Index> order, Index up);
  void look_through(Index from, Vec3 p, Nearest& best) const;
  [[nodiscard]] static double square_to(const Node& node, Vec3 p);

  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Node> nodes_;
  std::vector<Index> node_of_;  // by triangle
  double rounding_ = 0.0;       // of a distance, squared
};

template <class Visit>
void FacetTree::for_overlapping(Visit visit) const {
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
