#pragma once
// The edges of a planar or surface mesh with the elements on their sides, found star by star: nothing is kept of the edges inside.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// An edge between two distinct vertices, low < high.
struct Edge {
  Index low;
  Index high;
};

/// One element's traversal of an edge, seen from one of the edge's ends.
struct EdgeSide {
  Index element;
  bool leaving;  // whether the element's winding goes from that end to the other
};

/// Finds the edges at a vertex in its star. Volume elements are skipped, and so are edges between two corners of an element that are one
/// vertex (degenerate elements). Mesh and topology must outlive it.
class EdgeFinder {
 public:
  EdgeFinder(const Mesh& mesh, const Topology& topology) : elements_(&mesh.elements), topology_(&topology) {}

  /// Calls visit(other, sides) for every edge from `vertex` to a vertex `other` >= `least`, in ascending order of `other`.
  /// `sides` are the EdgeSides seen from `vertex`, in ascending order of their elements: one on the boundary, two inside, more where
  /// the mesh is not manifold.
  template <class Visit>
  void around(Index vertex, Index least, Visit&& visit) {
    const auto star = topology_->star(vertex);
    gather(star, vertex, least);
    for (std::size_t first = 0; first < keys_.size();) {
      const auto other = static_cast<Index>(keys_[first] >> 32U);
      std::size_t last = first;
      sides_.clear();
      for (; last < keys_.size() && keys_[last] >> 32U == other; ++last) {
        const auto place = static_cast<std::uint32_t>(keys_[last]);
        sides_.push_back({star[place / 2].element, place % 2 == 0});
      }
      visit(other, std::span<const EdgeSide>(sides_));
      first = last;
    }
  }

 private:
  void gather(std::span<const Incidence> star, Index vertex, Index least) {
    keys_.resize(2 * star.size());
    std::size_t count = 0;
    const auto add = [&](Index other, std::size_t place) {
      keys_[count] = (static_cast<std::uint64_t>(other) << 32U) | place;
      count += other >= least && other != vertex ? 1U : 0U;
    };
    for (std::size_t i = 0; i < star.size(); ++i) {
      if (info(elements_->kind(star[i].element)).dimension != 2) continue;
      const auto corners = elements_->corners(star[i].element);
      const std::size_t at = star[i].corner;
      add(corners[at + 1 < corners.size() ? at + 1 : 0], 2 * i);
      add(corners[at > 0 ? at - 1 : corners.size() - 1], 2 * i + 1);
    }
    keys_.resize(count);
    std::ranges::sort(keys_);
  }

  const ElementTable* elements_;
  const Topology* topology_;
  std::vector<std::uint64_t> keys_;  // sort key of each side: other end, then place in the star, then 0 for leaving or 1 for arriving
  std::vector<EdgeSide> sides_;
};

/// Calls visit(edge, sides) for every edge in ascending order of (low, high); sides as EdgeFinder gives them, seen from the low end.
template <class Visit>
void for_each_edge(const Mesh& mesh, const Topology& topology, Visit&& visit) {
  EdgeFinder finder(mesh, topology);
  for (Index low = 0; low < topology.vertex_count(); ++low) {
    finder.around(low, low + 1, [&](Index high, std::span<const EdgeSide> sides) { visit(Edge{low, high}, sides); });
  }
}

/// Results of one walk over all edges.
struct EdgeSurvey {
  struct BoundaryEdge {
    Edge edge;
    Index element;
  };
  Index edges = 0;
  std::vector<BoundaryEdge> boundary;  // edges with exactly one element, in ascending order
  std::vector<Edge> non_manifold;      // edges with more than two elements, in ascending order
  /// Whether any two elements on a manifold edge lie side by side (no duplicates) and run it in opposite directions.
  bool consistent = true;
  std::vector<Index> duplicates;  // elements with exactly the corners (as a set) of an earlier one, ascending
  /// By element, its edge-connected component (across manifold edges), numbered in the order of first elements; kNoIndex for volume
  /// elements.
  std::vector<Index> component;
  Index components = 0;
};

/// Whether the two elements have exactly the same corners, in whatever order.
[[nodiscard]] bool same_corners(const Mesh& mesh, Index a, Index b);

/// Walks over all edges once. Linear time for bounded valence. Throws Cancelled if `progress` (may be null) says so.
[[nodiscard]] EdgeSurvey survey_edges(const Mesh& mesh, const Topology& topology, Progress* progress);

/// Number of closed boundary curves. At a vertex where several curves touch, a curve continues along the fan of elements that it bounds.
/// Edges with more than two elements do not belong to the boundary here; a curve that such an edge interrupts counts once.
[[nodiscard]] Index count_boundary_loops(const Mesh& mesh, const Topology& topology, const EdgeSurvey& survey);

}  // namespace dmoscope
