#pragma once
// Walk over facets to the one above or below a point of a plane.

#include <array>
#include <optional>
#include <vector>

#include "core/reference/facets.h"

namespace dmoscope {

/// The walk of Facets::walk. `corners_of(facet)`: its corners projected into the plane, relative to the plane's origin.
template <class CornersOf>
[[nodiscard]] std::optional<FacetPlace> walk_facets(const Facets& facets, Index facet, Vec2<double> target, double least_cosine,
                                                    const CornersOf& corners_of) {
  constexpr double kWeightRounding = 1e-10;  // least weight, below 0, with which the line counts as meeting the facet
  constexpr int kLongestWalk = 256;
  Index before = kNoIndex;
  for (int step = 0; step < kLongestWalk; ++step) {
    std::array<Vec2<double>, 3> q = corners_of(facet);
    for (Vec2<double>& corner : q) corner = corner - target;
    const std::array<double, 3> part{cross(q[1], q[2]), cross(q[2], q[0]), cross(q[0], q[1])};
    const double area = cross(q[1] - q[0], q[2] - q[0]);
    if (!(area > least_cosine * facets.twice_area(facet))) return std::nullopt;
    const double below = -kWeightRounding * area;
    if (part[0] >= below && part[1] >= below && part[2] >= below) {
      FacetPlace found{facet, {std::max(part[0], 0.0), std::max(part[1], 0.0), std::max(part[2], 0.0)}};
      const double sum = found.weights[0] + found.weights[1] + found.weights[2];
      for (double& weight : found.weights) weight /= sum;
      return found;
    }
    // Crosses the edge that the target is farthest beyond; goes back only if there is no other way.
    const auto& across = facets.facets()[facet].across;
    std::size_t through = 3;
    for (const bool back : {false, true}) {
      for (std::size_t i = 0; i < 3 && (!back || through == 3); ++i)
        if (part[i] < below && across[i] != kNoIndex && (across[i] == before) == back && (through == 3 || part[i] < part[through]))
          through = i;
    }
    if (through == 3) return std::nullopt;
    before = facet;
    facet = across[through];
  }
  return std::nullopt;
}

/// Many walks over the same facets, from a place of the surface to the facets above or below points of the tangent plane there.
class FacetWalks {
 public:
  /// The projected facets that were met; memory that is kept from one vertex to the next.
  struct Room {
    struct Seen {
      Index facet;
      std::array<Vec2<double>, 3> corners;
    };
    std::vector<Seen> seen;
  };
  /// Prepares walks. `origin`: the place, and the plane's origin. All arguments must outlive it.
  FacetWalks(const Facets& facets, Index start, const Plane& plane, Vec3 origin, double least_cosine, Room& room)
      : facets_(facets), start_(start), plane_(plane), origin_(origin), least_cosine_(least_cosine), room_(room) {
    room_.seen.clear();
  }
  [[nodiscard]] std::optional<FacetPlace> to(Vec2<double> target) const {
    return walk_facets(
        facets_, start_, target, least_cosine_, [this](Index facet) -> const auto& { return corners_of(facet); });
  }

 private:
  const std::array<Vec2<double>, 3>& corners_of(Index facet) const {
    for (const auto& seen : room_.seen)
      if (seen.facet == facet) return seen.corners;
    return room_.seen.emplace_back(Room::Seen{facet, facets_.from_above(facet, plane_, origin_)}).corners;
  }

  const Facets& facets_;
  Index start_;
  const Plane& plane_;
  Vec3 origin_;
  double least_cosine_;
  Room& room_;
};

}  // namespace dmoscope
