#pragma once
// Relative windings of elements, and the winding that a component should get. Used to normalise orientation.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

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

/// Vote of a component's elements on their winding, as long as its first element keeps its own.
struct WindingVote {
  Index members = 0;
  std::int64_t balance = 0;        // positive minus negative elements
  double least = 0.0, most = 0.0;  // signed areas or volumes: no sum, which would depend on the order
  void add(double signed_measure) {
    ++members;
    balance += (signed_measure > 0 ? 1 : 0) - (signed_measure < 0 ? 1 : 0);
    least = std::min(least, signed_measure);
    most = std::max(most, signed_measure);
  }
  /// Adds the votes of other elements; `against`: if their first element is wound against this one's.
  void add(const WindingVote& other, bool against) {
    members += other.members;
    balance += against ? -other.balance : other.balance;
    least = std::min(least, against ? -other.most : other.least);
    most = std::max(most, against ? -other.least : other.most);
  }
  /// Whether to reverse the component: decided by the majority or, in a tie, by the largest element.
  [[nodiscard]] bool reverse() const { return members > 1 && (balance < 0 || (balance == 0 && -least > most)); }
};

/// Reverses an element, and records that in the mesh.
inline void turn_over(Mesh& mesh, Index element) {
  mesh.elements.flip(element);
  if (mesh.flipped.empty()) mesh.flipped.assign(mesh.elements.size(), 0);
  mesh.flipped[element] ^= 1U;
}

}  // namespace dmoscope
