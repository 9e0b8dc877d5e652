#pragma once
// Working memory of a visit, kept from one vertex to the next.

#include <tuple>
#include <vector>

#include "core/reference/facet_walk.h"
#include "core/reference/overlay.h"
#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/visit_watcher.h"

namespace dmoscope {

template <class Frame>
struct SearchRoom {
  CandidateList candidates;
  std::tuple<std::vector<double>, std::vector<Vec2<double>>, std::vector<Vec3>> coordinates;  // coordinates of candidates
  std::vector<StarPiece<Frame>> pieces;
  FacetWalks::Room walks;
  OverlayRoom overlay;
  VisitWatcher* watcher = nullptr;  // null: nobody looks on

  /// List of coordinates of one type: double on a curve, Vec2 in a plane and on a surface, Vec3 in space.
  template <class Coordinates>
  [[nodiscard]] std::vector<Coordinates>& list() {
    return std::get<std::vector<Coordinates>>(coordinates);
  }
};

}  // namespace dmoscope
