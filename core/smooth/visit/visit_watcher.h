#pragma once
// Interface through which a visit tells of its search.

#include <optional>

#include "core/search/candidate_grid.h"
#include "core/search/parameters.h"
#include "core/search/star.h"
#include "core/smooth/reference_visit.h"

namespace dmoscope {

/// Watcher of a visit, which is told of each of the visit's searches. Offsets are in mesh units, relative to the vertex's present place; of
/// two dimensions where z is 0.
class VisitWatcher {
 public:
  VisitWatcher() = default;
  VisitWatcher(const VisitWatcher&) = delete;
  VisitWatcher& operator=(const VisitWatcher&) = delete;
  virtual ~VisitWatcher() = default;

  struct Begin {
    double here = 0.0;      // score of the vertex's present place
    Vec3 start{};           // centre of the first grid: another place where that is better
    double at_start = 0.0;  // score there
    bool tangled = false;   // whether an element of the star is inverted
    bool single = false;    // whether candidates are rounded to float
  };
  /// A search begins; what was told before belongs to one that is given up.
  virtual void begin(const Begin& search) = 0;
  virtual void level(Vec3 centre, Vec3 size, int points) = 0;
  /// A candidate of the level, in the grid's order; a score of -infinity: the vertex cannot stand there.
  virtual void candidate(Vec3 at, double score) = 0;
  /// The level ends with the best place of all so far.
  virtual void found(Vec3 best) = 0;
  /// A place that was found, or one on the way to it, is judged by the statistics' formulas.
  virtual void judged(Confirmation found) = 0;
};

[[nodiscard]] inline Vec3 in_space(double x) { return {x, 0.0, 0.0}; }
[[nodiscard]] inline Vec3 in_space(Vec2<double> p) { return {p.x, p.y, 0.0}; }
[[nodiscard]] inline Vec3 in_space(Vec3 p) { return p; }

/// Tells a watcher of a search that cannot tell itself: its choice in level L is what it finds in L levels and not in L - 1. find(levels):
/// an offset in units of `scale`. `box`: in those units, too. score(offset): that of a candidate. Real: number of the candidates.
template <class Real, class Offset, class Score, class Find>
void tell_levels(VisitWatcher& watcher, const SearchParameters& parameters, double scale, Offset box, const Score& score,
                 const Find& find) {
  const auto told = [scale](const auto& p) { return in_space(times(point_of<double>(p), scale)); };
  const double here = score(Offset{});
  watcher.begin({.here = here, .at_start = here, .single = sizeof(Real) == sizeof(float)});
  auto centre = point_of<Real>(Offset{});
  double omega = parameters.omega;
  for (int level = 1; level <= parameters.levels; ++level) {
    const CandidateGrid<Real, decltype(centre)> grid{centre, times(point_of<Real>(box), static_cast<Real>(omega)), parameters.grid_points};
    watcher.level(told(grid.centre), told(grid.size), grid.points);
    for (int i = 0; i < grid.points; ++i)
      grid.for_slice(i, [&](int /*index*/, const auto& p) { watcher.candidate(told(p), score(point_of<double>(p))); });
    centre = point_of<Real>(find(level));
    watcher.found(told(centre));
    omega *= 2.0 / (parameters.grid_points - 1);
  }
}

}  // namespace dmoscope
