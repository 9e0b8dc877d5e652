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

}  // namespace

/// What both kinds of visit begin with.
template <class Frame>
struct Slide<Frame>::Visit {
  Index vertex;
  Vec3 here;
  PositionView positions;
  double scale;
  bool tangled;
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
      single_precision_(task.input->mesh.single_precision) {
  if (std::is_same_v<Frame, Curved> && task.search.precision != Precision::Double)
    kernel_ = composite_kernel<Plane>(task.search.simd.value_or(best_simd_level()), judge_.composite().first);
}

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
  const Visit visit{vertex, positions[vertex], positions, scratch.star.scale, tangled, score, scratch.room};
  return domain_->on_curve(vertex) ? along_curve(visit) : on_surface(visit, scratch);
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

/// Where a vertex on a surface stands, and the plane that touches it there.
template <class Frame>
struct Slide<Frame>::Tangent {
  FacetPlace place;
  Plane plane;
  Vec2<double> box;  // around the star's other vertices, in units of the star's scale
};

/// The winner in the tangent plane, of elements as they look from above; none where the kernel does not take the star.
template <class Frame>
std::optional<Vec2<double>> Slide<Frame>::search_flat(const Tangent& tangent, Scratch& scratch) const {
  if constexpr (!std::is_same_v<Frame, Curved>) {
    return std::nullopt;
  } else {
    if (kernel_ == nullptr) return std::nullopt;
    Star<double>& flat = scratch.flat;
    flat.triangles.clear();
    flat.quadrilaterals.clear();
    const auto from_above = [&](Vec3 p) { return tangent.plane.project(p); };
    for (const SurfaceTriangle& t : scratch.star.triangles) {
      const Vec2<double> b = from_above(t.b), c = from_above(t.c);
      flat.triangles.push_back(cross(b, c) > 0.0 ? StarTriangle<double>{b, c, 1.0} : StarTriangle<double>{c, b, 1.0});
    }
    for (const SurfaceQuadrilateral& q : scratch.star.quadrilaterals) {
      const Vec2<double> b = from_above(q.b), c = from_above(q.c), d = from_above(q.d);
      flat.quadrilaterals.push_back(cross(c, d - b) > 0.0 ? StarQuadrilateral<double>{b, c, d, 1.0}
                                                          : StarQuadrilateral<double>{d, c, b, 1.0});
    }
    CompositeSearch<Plane> task = search_for<Plane>(judge_.composite(), parameters_);
    task.star = lists_of(flat);
    task.box = tangent.box;
    const CompositeFound<Plane> found = kernel_(task);
    return found.ready ? std::optional(found.offset) : std::nullopt;
  }
}

/// The winner among places on the surface.
template <class Frame>
Vec2<double> Slide<Frame>::search_on_surface(const Visit& visit, const Tangent& tangent) const {
  const Facets& facets = domain_->facets();
  const auto worth = [&](Vec2<double> p) {
    if (p == Vec2<double>{}) return visit.score({});
    const auto found = facets.walk(tangent.place.facet, tangent.plane, visit.here, times(p, visit.scale), kSteepest);
    return found ? visit.score(times(mesh_.frame.offset(facets.at(*found), visit.here), 1.0 / visit.scale))
                 : -std::numeric_limits<double>::infinity();
  };
  return grid_search<double>(worth, tangent.box, parameters_).offset;
}

/// Where the vertex comes to stand a step away in the tangent plane, or half of it, and so on; nowhere if it may not.
template <class Frame>
std::optional<Vec3> Slide<Frame>::possible_on_surface(const Visit& visit, const Tangent& tangent, Vec2<double> step) const {
  const Facets& facets = domain_->facets();
  for (int i = 0; i <= kHalvings && !(step == Vec2<double>{}); ++i, step = times(step, 0.5)) {
    const auto there = facets.walk(tangent.place.facet, tangent.plane, visit.here, times(step, visit.scale), kSteepest);
    if (!there) continue;
    Vec3 target = facets.at(*there);
    if (single_precision_) {
      target = {nearest_float(target.x), nearest_float(target.y), nearest_float(target.z)};
      if (!facets.place(visit.vertex, target)) continue;
    }
    if (judge_.gains(visit.positions, visit.vertex, target) && fits(visit, target, &tangent.place, &*there)) return target;
  }
  return std::nullopt;
}

template <class Frame>
std::optional<Vec3> Slide<Frame>::on_surface(const Visit& visit, Scratch& scratch) const {
  if constexpr (!std::is_same_v<Frame, Plane>) {
    const auto place = domain_->facets().place(visit.vertex, visit.here);
    if (!place) return std::nullopt;
    const Vec3 normal = domain_->facets().normal(*place);
    if (normal == Vec3{}) return std::nullopt;
    Tangent tangent{*place, tangent_plane(normal), {}};
    tangent.box = box_of_star(mesh_, visit.positions, visit.vertex, tangent.plane, visit.scale);
    if (!visit.tangled) {
      if (const auto step = search_flat(tangent, scratch)) {
        if (*step == Vec2<double>{}) return std::nullopt;
        if (const auto target = possible_on_surface(visit, tangent, *step)) return target;
      }
    }
    return possible_on_surface(visit, tangent, search_on_surface(visit, tangent));
  }
  return std::nullopt;
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
