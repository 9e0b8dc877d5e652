#include "core/mesh/orientation.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/mesh/edges.h"

namespace dmoscope {
namespace {

/// Disjoint sets of elements that know for each element whether its winding agrees with that of its set's root.
class WindingSets {
 public:
  explicit WindingSets(Index count) : parent_(count), against_(count, 0) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  struct Place {
    Index root;
    std::uint8_t against;  // 1: wound against the root
  };
  Place find(Index e) {
    std::uint8_t against = 0;
    while (parent_[e] != e) {
      const Index parent = parent_[e];
      against_[e] ^= against_[parent];  // a root's own entry is 0
      parent_[e] = parent_[parent];
      against ^= against_[e];
      e = parent_[e];
    }
    return {e, against};
  }
  /// Says that a and b must be wound alike (0) or against each other (1). False where that contradicts what was said before.
  bool relate(Index a, Index b, std::uint8_t against) {
    const Place pa = find(a);
    const Place pb = find(b);
    const auto relation = static_cast<std::uint8_t>(pa.against ^ pb.against ^ against);
    if (pa.root == pb.root) return relation == 0;
    // The lowest element is the root: together with the edges' order this makes the result independent of the windings met.
    parent_[std::max(pa.root, pb.root)] = std::min(pa.root, pb.root);
    against_[std::max(pa.root, pb.root)] = relation;
    return true;
  }

 private:
  std::vector<Index> parent_;
  std::vector<std::uint8_t> against_;
};

double signed_area(const Mesh& mesh, const Plane& plane, Index e) { return 0.5 * dot(area_vector(mesh, e), plane.normal); }

/// For every element whether it is wound against the first one of its component. Counts the edges where that is impossible.
std::vector<std::uint8_t> relate_windings(const Mesh& mesh, const Topology& topology, Index& contradictions) {
  WindingSets sets(mesh.elements.size());
  for_each_edge(mesh, topology, [&](Edge, std::span<const EdgeSide> sides) {
    if (sides.size() != 2) return;
    const Index a = sides[0].element;
    const Index b = sides[1].element;
    if (a == b) return;  // an element that has a corner twice
    // Two neighbours that run their edge in the same direction are wound against each other; an element and its duplicate, which lie
    // on top of each other, are not.
    const bool same_direction = sides[0].leaving == sides[1].leaving;
    if (!sets.relate(a, b, same_direction != same_corners(mesh, a, b) ? 1 : 0)) ++contradictions;
  });
  std::vector<std::uint8_t> against(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) against[e] = sets.find(e).against;
  return against;
}

/// What a component's elements vote for when its first element keeps its winding.
struct Vote {
  Index members = 0;
  std::int64_t balance = 0;  // positive minus negative elements
  double area = 0.0;
  [[nodiscard]] bool reverse() const { return members > 1 && (balance < 0 || (balance == 0 && area < 0)); }
};

}  // namespace

OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane) {
  EdgeSurvey edges;
  Progress unwatched;
  const Topology topology(mesh, edges, unwatched);
  return normalise_orientation(mesh, plane, topology, edges);
}

OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane, const Topology& topology, const EdgeSurvey& edges) {
  const Index count = mesh.elements.size();
  OrientationReport report{.components = edges.components, .contradictions = static_cast<Index>(edges.non_manifold.size())};
  std::vector<std::uint8_t> against;  // empty: none is
  if (!edges.consistent) against = relate_windings(mesh, topology, report.contradictions);
  const auto is_against = [&](Index e) { return !against.empty() && against[e] != 0; };

  std::vector<Vote> votes(edges.components);
  for (Index e = 0; e < count; ++e) {
    if (edges.component[e] == kNoIndex) continue;
    const double area = is_against(e) ? -signed_area(mesh, plane, e) : signed_area(mesh, plane, e);
    Vote& vote = votes[edges.component[e]];
    ++vote.members;
    vote.balance += (area > 0 ? 1 : 0) - (area < 0 ? 1 : 0);
    vote.area += area;
  }
  for (Index e = 0; e < count; ++e) {
    if (edges.component[e] == kNoIndex || is_against(e) == votes[edges.component[e]].reverse()) continue;
    mesh.elements.flip(e);
    if (mesh.flipped.empty()) mesh.flipped.assign(count, 0);
    mesh.flipped[e] ^= 1U;
    ++report.flipped;
  }
  if (std::ranges::none_of(mesh.flipped, [](std::uint8_t f) { return f != 0; })) mesh.flipped.clear();
  return report;
}

}  // namespace dmoscope
