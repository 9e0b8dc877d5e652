#include "core/smooth/methods/slide.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/rounding.h"

namespace dmoscope {

namespace {

/// Width and height of the box around the star's other vertices in a plane, in units of `scale`.
template <class Frame>
Vec2<double> box_of_star(const MeshView<Frame>& mesh, PositionView positions, Index vertex, const Plane& plane, double scale) {
  Vec2<double> low{}, high{};
  for (const Incidence& at : mesh.star(vertex)) {
    for (const Index other : mesh.corners_of(at.element)) {
      const Vec2<double> p = plane.offset(positions[other], positions[vertex]);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  return times(high - low, 1.0 / scale);
}

/// How often the way is halved where a vertex may not go all of it.
constexpr int kHalvings = 3;
/// Of 60 degrees: how far a face may lean away from the facets beneath it.
constexpr double kLeastCosine = 0.5;

}  // namespace

/// What both kinds of visit begin with.
template <class Frame>
struct Slide<Frame>::Visit {
  Index vertex;
  Vec3 here;
  PositionView positions;
  double scale;
  const CompositeScore<Frame>& score;
  OverlayRoom& room;
};

/// What a visit knows of its curve.
template <class Frame>
struct Slide<Frame>::Stretch {
  double place;
  Curves::Neighbours beside;
};

CompositeObjective single_objective(Metric metric) { return {metric, std::numeric_limits<double>::infinity(), metric}; }

template <class Frame>
Slide<Frame>::Slide(const SmoothingTask& task, CompositeObjective composite)
    : domain_(task.domain),
      judge_(*task.input, std::move(composite)),
      mesh_(task.input->view<Frame>()),
      parameters_(task.search),
      max_deviation_(task.max_deviation),
      single_precision_(task.input->mesh.single_precision) {}

template <class Frame>
void Slide<Frame>::begin(const Sweep& sweep) {
  judge_.begin(sweep);
}

template <class Frame>
std::optional<Vec3> Slide<Frame>::target(PositionView positions, Index vertex, Scratch& scratch) const {
  judge_.gather(positions, vertex, scratch.star);
  const bool tangled = judge_.is_tangled(scratch.star);
  if (judge_.untangling().repair && !tangled) return std::nullopt;
  const auto score = judge_.score_of(scratch.star, positions, vertex, tangled);
  const Visit visit{vertex, positions[vertex], positions, scratch.star.scale, score, scratch.room};
  return domain_->on_curve(vertex) ? along_curve(visit) : on_surface(visit);
}

/// The best place; the vertex's own where none is better.
template <class Frame>
double Slide<Frame>::search(const Visit& visit, const Stretch& stretch) const {
  const Curves& curves = domain_->curves();
  const auto worth = [&](double place) {
    return visit.score(times(mesh_.frame.offset(curves.at(visit.vertex, place), visit.here), 1.0 / visit.scale));
  };
  const int candidates = parameters_.grid_points * parameters_.grid_points;
  double best = stretch.place, objective = visit.score({}), omega = parameters_.omega;
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

template <class Frame>
bool Slide<Frame>::keeps_near(const Visit& visit, const Stretch& stretch, double place, Vec3 target) const {
  const auto& beside = stretch.beside;
  const Curves& curves = domain_->curves();
  const auto deviation = [&](double at, Vec3 position) {
    return std::max(curves.deviation(visit.vertex, beside.place_before, at, visit.positions[beside.before], position),
                    curves.deviation(visit.vertex, at, beside.place_after, position, visit.positions[beside.after]));
  };
  const double there = deviation(place, target);
  return there <= max_deviation_ || there <= deviation(stretch.place, visit.here);
}

/// Where the vertex comes to stand at a place of its curve; nowhere if it may not.
template <class Frame>
std::optional<Vec3> Slide<Frame>::possible(const Visit& visit, const Stretch& stretch, double place) const {
  const Curves& curves = domain_->curves();
  const Vec3 target = curves.at(visit.vertex, place);
  // What rounding put elsewhere must still be between the neighbours.
  const auto landed = curves.place(visit.vertex, target);
  if (!landed || !curves.neighbours(visit.vertex, *landed, visit.positions)) return std::nullopt;
  if (!judge_.gains(visit.positions, visit.vertex, target) || !keeps_near(visit, stretch, place, target)) return std::nullopt;
  return fits(visit, target, nullptr, nullptr) ? std::optional(target) : std::nullopt;
}

template <class Frame>
std::optional<Vec3> Slide<Frame>::along_curve(const Visit& visit) const {
  const Curves& curves = domain_->curves();
  const auto place = curves.place(visit.vertex, visit.here);
  if (!place) return std::nullopt;
  const auto beside = curves.neighbours(visit.vertex, *place, visit.positions);
  if (!beside) return std::nullopt;
  const Stretch stretch{*place, *beside};
  double found = search(visit, stretch);
  for (int i = 0; i <= kHalvings && found != *place; ++i) {
    if (const auto target = possible(visit, stretch, found)) return target;
    if constexpr (std::is_same_v<Frame, Plane>) break;
    found = *place + 0.5 * (found - *place);
  }
  return std::nullopt;
}

/// Do the faces around keep near the input with the vertex at `target`? `here`, `there`: the facets beneath, of a vertex on a surface.
template <class Frame>
bool Slide<Frame>::fits(const Visit& visit, Vec3 target, const FacetPlace* here, const FacetPlace* there) const {
  if (!domain_->facets().any()) return true;
  Overlay overlay(*domain_, visit.room);
  const Fit fit = overlay.star(visit.positions, visit.vertex, target, there);
  if (std::max(fit.deviation, fit.other_split) <= max_deviation_ && fit.least_cosine >= kLeastCosine) return true;
  if (fit.deviation == kNoFit.deviation) return false;
  const Fit now = overlay.star(visit.positions, visit.vertex, visit.here, here);
  if (now.deviation == kNoFit.deviation) return false;
  return fit.deviation <= std::max(max_deviation_, now.deviation) && fit.other_split <= std::max(max_deviation_, now.other_split) &&
         fit.least_cosine >= std::min(kLeastCosine, now.least_cosine);
}

template <class Frame>
std::optional<Vec3> Slide<Frame>::on_surface(const Visit& visit) const {
  if constexpr (std::is_same_v<Frame, Plane>) {
    return std::nullopt;
  } else {
    const Facets& facets = domain_->facets();
    const auto place = facets.place(visit.vertex, visit.here);
    if (!place) return std::nullopt;
    const Vec3 normal = facets.normal(*place);
    if (normal == Vec3{}) return std::nullopt;
    const Plane tangent = tangent_plane(normal);
    const auto walk = [&](Vec2<double> p) {
      return facets.walk(place->facet, tangent, visit.here, times(p, visit.scale), kLeastCosine / 5.0);
    };
    const auto worth = [&](Vec2<double> p) {
      if (p == Vec2<double>{}) return visit.score({});
      const auto found = walk(p);
      return found ? visit.score(times(mesh_.frame.offset(facets.at(*found), visit.here), 1.0 / visit.scale))
                   : -std::numeric_limits<double>::infinity();
    };
    Vec2<double> step =
        grid_search<double>(worth, box_of_star(mesh_, visit.positions, visit.vertex, tangent, visit.scale), parameters_).offset;
    for (int i = 0; i <= kHalvings && !(step == Vec2<double>{}); ++i, step = times(step, 0.5)) {
      const auto there = walk(step);
      if (!there) continue;
      Vec3 target = facets.at(*there);
      if (single_precision_) target = {nearest_float(target.x), nearest_float(target.y), nearest_float(target.z)};
      if (!facets.place(visit.vertex, target)) continue;
      if (judge_.gains(visit.positions, visit.vertex, target) && fits(visit, target, &*place, &*there)) return target;
    }
    return std::nullopt;
  }
}

template class Slide<Plane>;
template class Slide<Space>;
template class Slide<Curved>;

namespace {
/// Nothing moves by it.
struct NobodyIsFree {
  struct Scratch {};
  static constexpr bool kDependsOnStarAlone = true;
  static constexpr std::size_t kGrain = 32;
  void begin(const Sweep& /*sweep*/) {}
  [[nodiscard]] std::optional<Vec3> target(PositionView /*positions*/, Index /*vertex*/, Scratch& /*scratch*/) const {
    return std::nullopt;
  }
};
}  // namespace

std::unique_ptr<Smoother> make_surface_smoother(const SmoothingTask& task, CompositeObjective composite) {
  return make_sliding_smoother<Curved>(task, NobodyIsFree{}, std::move(composite));
}

}  // namespace dmoscope
