#include "mpi/mesh/shared_winding.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/mesh/edges.h"
#include "core/mesh/orientation.h"
#include "core/mesh/winding_sets.h"

namespace dmoscope {
namespace {

/// Name of a set of connected elements of a share: its lowest element in the whole mesh and the rank, since sets of several ranks may have
/// one lowest element.
struct SetName {
  WholeIndex lowest;
  std::uint64_t rank;
  friend bool operator==(const SetName&, const SetName&) = default;
  friend auto operator<=>(const SetName&, const SetName&) = default;
};

/// Votes of a set's elements that the rank counts, for the lowest element to keep its winding.
struct SetVotes {
  SetName set;
  WindingVote vote;
};

/// A pair of sets of different ranks with an element in common.
struct Common {
  SetName here, there;
  std::uint64_t against;  // 1: their lowest elements are wound against each other
};

class Orienter {
 public:
  Orienter(const World& world, const Share& share, Mesh& mesh, const Geometry& geometry)
      : world_(world), share_(share), mesh_(mesh), geometry_(geometry), sets_(mesh.elements.size()) {}

  /// Relates elements across edges and faces with an owned corner: of these alone all elements are known.
  void relate(const Topology& topology) {
    for_each_edge(mesh_, topology, [&](Edge edge, std::span<const EdgeSide> sides) {
      if (sides.size() != 2 || sides[0].element == sides[1].element || (!is_owned(edge.low) && !is_owned(edge.high))) return;
      const Index a = sides[0].element, b = sides[1].element;
      const bool same_direction = sides[0].leaving == sides[1].leaving;
      contradicted_ = !sets_.relate(a, b, same_direction != same_corners(mesh_, a, b) ? 1 : 0) || contradicted_;
    });
  }
  void relate(const FaceNeighbours& faces) {
    for (Index e = 0; e < mesh_.elements.size(); ++e) {
      const auto across = faces.of(e);
      for (Index f = 0; f < across.size(); ++f) {
        if (across[f] == kNoIndex || across[f] <= e) continue;
        const auto corners = vertices_of(mesh_.elements, {e, f});
        if (std::ranges::none_of(corners, [&](Index v) { return v != kNoIndex && is_owned(v); })) continue;
        const ElementFace other{across[f], faces.face_across(mesh_.elements, {e, f})};
        contradicted_ = !sets_.relate(e, other.element, same_direction(mesh_.elements, {e, f}, other) ? 1 : 0) || contradicted_;
      }
    }
  }

  Index orient() {
    const std::vector<SetVotes> votes = world_.gather(votes_here());
    const std::vector<Common> common = world_.gather(sets_in_common());
    const std::vector<SetName> turned = decide(votes, common);
    return turn_over_here(turned);
  }

 private:
  [[nodiscard]] bool is_owned(Index v) const { return share_.owner[v] == world_.rank(); }
  [[nodiscard]] SetName name(Index root) const { return {share_.elements[root], static_cast<std::uint64_t>(world_.rank())}; }
  [[nodiscard]] double measure(Index e) const {
    return geometry_.shape == Shape::Volume ? signed_volume(mesh_, e)
                                            : 0.5 * dot(area_vector(mesh_, e, geometry_.plane), geometry_.plane.normal);
  }

  /// Votes of each set of this share.
  [[nodiscard]] std::vector<SetVotes> votes_here() {
    std::unordered_map<Index, WindingVote> votes;
    const double whole = std::pow(geometry_.size, geometry_.shape == Shape::Volume ? 3 : 2);
    for (Index e = 0; e < mesh_.elements.size(); ++e) {
      const auto place = sets_.find(e);
      WindingVote& vote = votes[place.root];
      if (share_.home[e] != 0) vote.add(place.against != 0 ? -measure(e) : measure(e), whole);
    }
    std::vector<SetVotes> all;
    for (const auto& [root, vote] : votes) all.push_back({name(root), vote});
    std::ranges::sort(all, {}, &SetVotes::set);
    return all;
  }

  /// Finds the common sets: each rank asks the one that counts an element for its set there.
  [[nodiscard]] std::vector<Common> sets_in_common() {
    struct Known {
      WholeIndex element;
      SetName set;
      std::uint64_t against;
    };
    const auto each = [&](const auto& give) {
      for (Index e = 0; e < mesh_.elements.size(); ++e) {
        if (share_.home[e] != 0) continue;
        const auto place = sets_.find(e);
        give(share_.owner[std::ranges::min(mesh_.elements.corners(e))], Known{share_.elements[e], name(place.root), place.against});
      }
    };
    std::vector<Common> all;
    for (const Known& known : world_.exchange(deal<Known>(world_, each)).values) {
      const auto at = std::ranges::lower_bound(share_.elements, known.element) - share_.elements.begin();
      const auto place = sets_.find(static_cast<Index>(at));
      all.push_back({name(place.root), known.set, place.against ^ known.against});
    }
    const auto key = [](const Common& one) { return std::tuple(one.here, one.there, one.against); };
    std::ranges::sort(all, {}, key);
    all.erase(std::unique(all.begin(), all.end(), [&](const Common& a, const Common& b) { return key(a) == key(b); }), all.end());
    return all;
  }

  /// Joins the ranks' sets on rank 0 and returns, on all ranks, the names of those whose lowest element is to be turned over.
  [[nodiscard]] std::vector<SetName> decide(const std::vector<SetVotes>& votes, const std::vector<Common>& common) {
    std::vector<SetName> turned;
    world_.together([&] {
      // Sorted by their lowest elements: the root of a joined set is the lowest of all.
      std::vector<SetVotes> sorted = votes;
      std::ranges::sort(sorted, {}, &SetVotes::set);
      const auto number = [&](const SetName& set) {
        return static_cast<Index>(std::ranges::lower_bound(sorted, set, {}, &SetVotes::set) - sorted.begin());
      };
      WindingSets joined(static_cast<Index>(sorted.size()));
      for (const Common& one : common)
        contradicted_ = !joined.relate(number(one.here), number(one.there), static_cast<std::uint8_t>(one.against)) || contradicted_;
      if (contradicted_)
        throw InputError(mesh_.name, 0,
                         "elements are wound so that no winding suits all of them; one process alone can smooth such a mesh");
      std::vector<WindingVote> all(sorted.size());
      for (Index i = 0; i < sorted.size(); ++i) {
        const auto place = joined.find(i);
        all[place.root].add(sorted[i].vote, place.against != 0);
      }
      for (Index i = 0; i < sorted.size(); ++i) {
        const auto place = joined.find(i);
        if ((place.against != 0) != all[place.root].reverse()) turned.push_back(sorted[i].set);
      }
    });
    world_.broadcast(turned, 0);
    return turned;
  }

  Index turn_over_here(const std::vector<SetName>& turned) {
    std::vector<WholeIndex> mine;
    for (const SetName& set : turned)
      if (set.rank == static_cast<std::uint64_t>(world_.rank())) mine.push_back(set.lowest);
    std::ranges::sort(mine);
    Index count = 0;
    for (Index e = 0; e < mesh_.elements.size(); ++e) {
      const auto place = sets_.find(e);
      const bool lowest_turned = std::ranges::binary_search(mine, share_.elements[place.root]);
      if (lowest_turned == (place.against != 0)) continue;
      turn_over(mesh_, e);
      ++count;
    }
    return count;
  }

  const World& world_;
  const Share& share_;
  Mesh& mesh_;
  const Geometry& geometry_;
  WindingSets sets_;
  bool contradicted_ = false;
};

}  // namespace

Index orient_share(const World& world, const Share& share, Mesh& mesh, const Geometry& geometry, const Topology& topology,
                   const FaceNeighbours* faces) {
  Orienter orienter(world, share, mesh, geometry);
  if (faces != nullptr)
    orienter.relate(*faces);
  else
    orienter.relate(topology);
  return orienter.orient();
}

}  // namespace dmoscope
