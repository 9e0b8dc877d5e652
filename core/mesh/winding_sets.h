#pragma once
// Relative windings of elements, and the winding that a component should get. Used to normalise orientation.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "core/base/box.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Disjoint sets of elements that store for each element whether its winding agrees with that of its set's root.
class WindingSets {
 public:
  explicit WindingSets(Index count) : parent_(count), against_(count, 0) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  struct Place {
    Index root;
    std::uint8_t against;  // whether it is wound against the root (1)
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
  /// Records that a and b must be wound alike (0) or against each other (1). False if that contradicts an earlier relation.
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

/// Bound of the measure of a mesh's box: its diagonal to the power of the dimension.
inline double box_measure(const Mesh& mesh, int dimension) {
  if (mesh.positions.empty()) return 1.0;
  const PointBox box = box_of(mesh.positions);
  return std::pow(length(box.high - box.low), dimension);
}

/// Votes of a component's elements when its first element keeps its winding.
struct WindingVote {
  Index members = 0;
  std::int64_t balance = 0;        // positive minus negative elements
  std::int64_t sum = 0;            // of signed areas or volumes, in small whole parts of the mesh's: it does not depend on the order
  double least = 0.0, most = 0.0;  // of these
  /// `whole`: what the mesh's box measures at most, roughly.
  void add(double signed_measure, double whole) {
    constexpr double kParts = 1U << 28U, kMost = 1U << 30U;
    ++members;
    balance += (signed_measure > 0 ? 1 : 0) - (signed_measure < 0 ? 1 : 0);
    const double parts = kParts * (signed_measure / whole);
    if (std::fabs(parts) < kMost) sum += std::llround(parts);
    least = std::min(least, signed_measure);
    most = std::max(most, signed_measure);
  }
  /// Adds the votes of other elements; `against`: if their first element is wound against this one's.
  void add(const WindingVote& other, bool against) {
    members += other.members;
    balance += against ? -other.balance : other.balance;
    sum += against ? -other.sum : other.sum;
    least = std::min(least, against ? -other.most : other.least);
    most = std::max(most, against ? -other.least : other.most);
  }
  /// By a clear majority; where the mesh is so tangled that there is none, by what it encloses, which its inner vertices have no part in;
  /// else by the majority or the largest element.
  [[nodiscard]] bool reverse() const {
    if (members < 2) return false;
    const bool is_clear = 2 * std::abs(balance) > static_cast<std::int64_t>(members);
    if (!is_clear && sum != 0) return sum < 0;
    return balance < 0 || (balance == 0 && -least > most);
  }
};

/// Reverses an element, and records that in the mesh.
inline void turn_over(Mesh& mesh, Index element) {
  mesh.elements.flip(element);
  if (mesh.flipped.empty()) mesh.flipped.assign(mesh.elements.size(), 0);
  mesh.flipped[element] ^= 1U;
}

}  // namespace dmoscope
