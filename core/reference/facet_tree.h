#pragma once
// Boxes around boxes around triangles: finds the nearest one.

#include <array>
#include <span>
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
  /// `patch_of`: by triangle, 0 to patches - 1.
  FacetTree(std::vector<std::array<Vec3, 3>> triangles, std::span<const Index> patch_of, Index patches);

  struct Nearest {
    Index triangle = kNoIndex;
    NearestPoint point;
  };
  /// Of the triangles of a patch the nearest; of equals the first. `near`: one of them to begin with, any.
  [[nodiscard]] Nearest nearest(Index patch, Vec3 p, Index near) const;

 private:
  struct Node {
    Vec3 low, high;
    Index left, right;   // kNoIndex: none, it holds triangles
    Index first, count;  // of order_
  };
  Index build(std::size_t first, std::size_t last);
  [[nodiscard]] static double square_to(const Node& node, Vec3 p);

  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
  std::vector<Index> roots_;  // by patch
  double rounding_ = 0.0;     // of a distance, squared
};

}  // namespace dmoscope
