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

/// Have the two elements the very same corners? Such lie on top of each other, not side by side.
bool duplicates(const Mesh& mesh, Index a, Index b) {
  return std::ranges::is_permutation(mesh.elements.corners(a), mesh.elements.corners(b));
}

bool planar(const Mesh& mesh, Index e) { return info(mesh.elements.kind(e)).dimension == 2; }

/// What a component's elements vote for when its root keeps its winding.
struct Vote {
  Index members = 0;
  std::int64_t balance = 0;  // positive minus negative elements
  double area = 0.0;
  [[nodiscard]] bool reverse() const { return members > 1 && (balance < 0 || (balance == 0 && area < 0)); }
};

}  // namespace

OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane) { return normalise_orientation(mesh, plane, EdgeTable(mesh)); }

OrientationReport normalise_orientation(Mesh& mesh, const Plane& plane, const EdgeTable& edges) {
  OrientationReport report;
  const Index count = mesh.elements.size();
  const auto corners = mesh.elements.all_corners();
  WindingSets sets(count);
  for (Index i = 0; i < edges.size(); ++i) {
    const auto sides = edges.sides(i);
    if (sides.size() == 1) continue;
    if (sides.size() > 2) {
      ++report.contradictions;
      continue;
    }
    const Index a = edges.element(sides[0]);
    const Index b = edges.element(sides[1]);
    if (a == b) continue;  // an element that has a corner twice
    // Two neighbours that run their edge in the same direction are wound against each other; an element and its duplicate are not.
    const bool same_direction = corners[sides[0]] == corners[sides[1]];
    if (!sets.relate(a, b, same_direction != duplicates(mesh, a, b) ? 1 : 0)) ++report.contradictions;
  }

  std::vector<Vote> votes(count);
  for (Index e = 0; e < count; ++e) {
    if (!planar(mesh, e)) continue;
    const auto [root, against] = sets.find(e);
    const double area = against != 0 ? -signed_area(mesh, plane, e) : signed_area(mesh, plane, e);
    Vote& vote = votes[root];
    report.components += vote.members == 0 ? 1 : 0;
    ++vote.members;
    vote.balance += (area > 0 ? 1 : 0) - (area < 0 ? 1 : 0);
    vote.area += area;
  }
  for (Index e = 0; e < count; ++e) {
    if (!planar(mesh, e)) continue;
    const auto [root, against] = sets.find(e);
    if ((against != 0) == votes[root].reverse()) continue;
    mesh.elements.flip(e);
    if (mesh.flipped.empty()) mesh.flipped.assign(count, 0);
    mesh.flipped[e] ^= 1U;
    ++report.flipped;
  }
  if (std::ranges::none_of(mesh.flipped, [](std::uint8_t f) { return f != 0; })) mesh.flipped.clear();
  return report;
}

Index count_components(const Mesh& mesh, const EdgeTable& edges) {
  WindingSets sets(mesh.elements.size());
  for (Index i = 0; i < edges.size(); ++i) {
    const auto sides = edges.sides(i);
    if (sides.size() == 2) sets.relate(edges.element(sides[0]), edges.element(sides[1]), 0);
  }
  Index components = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e) components += planar(mesh, e) && sets.find(e).root == e ? 1 : 0;
  return components;
}

}  // namespace dmoscope
