#include "core/smooth/methods/curve_slide.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dmoscope {

/// What a visit knows of its curve.
struct CurveSlide::Stretch {
  Index vertex;
  double place;
  Curves::Neighbours beside;
};

CompositeObjective single_objective(Metric metric) { return {metric, std::numeric_limits<double>::infinity(), metric}; }

CurveSlide::CurveSlide(const SmoothingTask& task, CompositeObjective composite)
    : curves_(task.curves),
      rule_(*task.input, std::move(composite), task.search),
      plane_(task.input->geometry.plane),
      parameters_(task.search),
      max_deviation_(task.max_deviation) {}

void CurveSlide::begin(const Sweep& sweep) {
  untangling_ = sweep.untangling;
  rule_.begin(sweep);
}

/// The best place; the vertex's own where none is better.
double CurveSlide::search(const Stretch& stretch, const CompositeScore<Plane>& score, Vec3 here, double scale) const {
  const auto worth = [&](double place) { return score(times(plane_.offset(curves_->at(stretch.vertex, place), here), 1.0 / scale)); };
  const int candidates = parameters_.grid_points * parameters_.grid_points;
  double best = stretch.place, objective = score({}), omega = parameters_.omega;
  for (int level = 0; level < parameters_.levels; ++level) {
    const double centre = best, width = omega * (stretch.beside.place_after - stretch.beside.place_before);
    for (int i = 0; i < candidates; ++i) {
      const double place = centre + width * (static_cast<double>(i) / (candidates - 1) - 0.5);
      if (!(stretch.beside.place_before < place && place < stretch.beside.place_after)) continue;
      const double value = worth(place);
      if (value > objective) best = place, objective = value;
    }
    omega *= 2.0 / (candidates - 1);
  }
  return best;
}

bool CurveSlide::keeps_near(const Stretch& stretch, PositionView positions, double place, Vec3 target) const {
  const auto& beside = stretch.beside;
  const auto deviation = [&](double at, Vec3 position) {
    return std::max(curves_->deviation(stretch.vertex, beside.place_before, at, positions[beside.before], position),
                    curves_->deviation(stretch.vertex, at, beside.place_after, position, positions[beside.after]));
  };
  const double there = deviation(place, target);
  return there <= max_deviation_ || there <= deviation(stretch.place, positions[stretch.vertex]);
}

std::optional<Vec3> CurveSlide::target(PositionView positions, Index vertex, Scratch& star) const {
  const Vec3 here = positions[vertex];
  const auto place = curves_->place(vertex, here);
  if (!place) return std::nullopt;
  const auto beside = curves_->neighbours(vertex, *place, positions);
  if (!beside) return std::nullopt;
  const Stretch stretch{vertex, *place, *beside};
  rule_.gather(positions, vertex, star);
  const bool tangled = rule_.is_tangled(star);
  if (untangling_.repair && !tangled) return std::nullopt;
  const double found = search(stretch, rule_.score_of(star, positions, vertex, tangled), here, star.scale);
  if (found == *place) return std::nullopt;
  const Vec3 target = curves_->at(vertex, found);
  // What rounding put elsewhere must still be between the neighbours.
  const auto landed = curves_->place(vertex, target);
  if (!landed || !curves_->neighbours(vertex, *landed, positions)) return std::nullopt;
  return rule_.gains(positions, vertex, target) && keeps_near(stretch, positions, found, target) ? std::optional(target) : std::nullopt;
}

}  // namespace dmoscope
