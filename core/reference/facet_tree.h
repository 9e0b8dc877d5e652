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
  /// `patch_of`: by triangle.
  FacetTree(std::vector<std::array<Vec3, 3>> triangles, std::span<const Index> patch_of);

  struct Nearest {
    Index triangle = kNoIndex;
    NearestPoint point;
  };
  /// Of the triangles of a patch the nearest; of equals the first. `near`: one of them to begin with, any; the nearer, the faster.
  [[nodiscard]] Nearest nearest(Vec3 p, Index near) const;

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

}  // namespace dmoscope
