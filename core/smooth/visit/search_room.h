#pragma once
// What a visit works in, kept from one vertex to the next.

#include <tuple>
#include <vector>

#include "core/reference/facet_walk.h"
#include "core/reference/overlay.h"
#include "core/smooth/visit/star_judge.h"

namespace dmoscope {

template <class Frame>
struct SearchRoom {
  CandidateList candidates;
  std::tuple<std::vector<double>, std::vector<Vec2<double>>, std::vector<Vec3>> coordinates;  // of the candidates, where they count
  std::vector<StarPiece<Frame>> pieces;
  FacetWalks::Room walks;
  OverlayRoom overlay;

  /// Of a kind that the frame's own offsets, the places on a curve, or those on a surface are.
  template <class Coordinates>
  [[nodiscard]] std::vector<Coordinates>& list() {
    return std::get<std::vector<Coordinates>>(coordinates);
  }
};

}  // namespace dmoscope
