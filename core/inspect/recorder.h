#pragma once
// Recorder of a search's reports.

#include <vector>

#include "core/inspect/visit_trace.h"
#include "core/search/grid_search.h"

namespace dmoscope {

/// A trace for grid_search(): records what the search reports, in mesh units. Offset: Vec2<double> or Vec3.
template <class Offset>
class Recorder {
 public:
  explicit Recorder(double scale) : scale_(scale) {}

  template <class Real>
  void begin(const Real& objective) {
    here = static_cast<double>(objective);
    best_ = at_start = here;
  }
  template <class Real, class Point>
  void start(const Candidate<Real, Point>& best) {
    started = in_mesh_units(best.offset);
    best_ = at_start = static_cast<double>(best.objective);
  }
  template <class Real, class Point>
  void level(const CandidateGrid<Real, Point>& grid) {
    TracedLevelIn<Offset>& level = levels.emplace_back();
    level.centre = in_mesh_units(grid.centre);
    level.size = in_mesh_units(grid.size);
    level.points = grid.points;
  }
  template <class Real, class Point>
  void candidate(int /*index*/, const Point& offset, const Real& objective) {
    levels.back().offsets.push_back(in_mesh_units(offset));
    levels.back().values.push_back(static_cast<double>(objective));
  }
  template <class Real, class Point>
  void found(const Candidate<Real, Point>& best) {
    if (static_cast<double>(best.objective) > best_) choose(best.offset);
    best_ = static_cast<double>(best.objective);
  }
  /// Marks the level's candidate at this offset, compared by its bits, as the one chosen.
  template <class Point>
  void choose(const Point& offset) {
    const Offset chosen = in_mesh_units(offset);
    const auto& all = levels.back().offsets;
    for (std::size_t i = 0; i < all.size() && !levels.back().best; ++i)
      if (all[i] == chosen) levels.back().best = static_cast<int>(i);
  }

  std::vector<TracedLevelIn<Offset>> levels;
  double here = 0.0;
  Offset started{};       // centre of the first grid
  double at_start = 0.0;  // objective at that centre

 private:
  template <class Real>
  [[nodiscard]] Vec2<double> in_mesh_units(Vec2<Real> offset) const {
    return {static_cast<double>(offset.x) * scale_, static_cast<double>(offset.y) * scale_};
  }
  template <class Real>
  [[nodiscard]] Vec3 in_mesh_units(Vec3Of<Real> offset) const {
    return {static_cast<double>(offset.x) * scale_, static_cast<double>(offset.y) * scale_, static_cast<double>(offset.z) * scale_};
  }

  double scale_;
  double best_ = 0.0;
};

}  // namespace dmoscope
