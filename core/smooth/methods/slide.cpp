#include "core/smooth/methods/slide.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/rounding.h"
#include "core/search/compass_search.h"

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
/// What a place is worth where no vertex may stand.
constexpr double kNothing = -std::numeric_limits<double>::infinity();

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
  Scratch& scratch;
  mutable std::optional<Fit> fit_now{};  // of the faces around, once it is known
};

/// What a visit knows of its curve.
template <class Frame>
struct Slide<Frame>::Stretch {
  double place;
  Curves::Neighbours beside;
};

CompositeObjective single_objective(Metric metric) { return {metric, std::numeric_limits<double>::infinity(), metric}; }

template <class Frame>
Slide<Frame>::Slide(const SmoothingTask& task, CompositeObjective composite, SlideChoice choice)
    : domain_(task.domain),
      judge_(*task.input, std::move(composite)),
      mesh_(task.input->view<Frame>()),
      parameters_(task.search),
      choice_(choice),
      single_precision_(task.input->mesh.single_precision) {
  const CompositeObjective& aims = judge_.composite();
  if (task.search.precision != Precision::Double && is_for_kernels(aims)) {
    const SimdLevel level = task.search.simd.value_or(best_simd_level());
    if (std::is_same_v<Frame, Curved>) flat_kernel_ = composite_kernel<Plane>(level, aims.first);
    if (!std::holds_alternative<std::shared_ptr<const SizeField>>(aims.second))
      list_kernel_ = composite_list_kernel<Frame>(level, aims.first);
  }
  flat_aims_ = search_for<Plane>(aims, parameters_);
  aims_ = search_for<Frame>(aims, parameters_);
  if (domain_ != nullptr) bound_.emplace(*domain_, task.max_deviation);
  if (domain_ != nullptr && domain_->faces().any()) found_.resize(task.input->mesh.positions.size());
}

template <class Frame>
void Slide<Frame>::begin(const Sweep& sweep) {
  judge_.begin(sweep);
}

template <class Frame>
std::optional<Vec3> Slide<Frame>::target(PositionView positions, Index vertex, Scratch& scratch) const {
  judge_.gather(positions, vertex, scratch.star);
  const bool tangled = judge_.is_tangled(scratch.star);
  if (judge_.untangling().repair && choice_.must_gain && !tangled) return std::nullopt;
  const auto score = judge_.score_of(scratch.star, positions, vertex, tangled);
  const Visit visit{vertex, positions[vertex], positions, scratch.star.scale, tangled, score, scratch};
  return domain_->on_curve(vertex) ? along_curve(visit) : on_surface(visit);
}

/// In units of the star's scale.
template <class Frame>
typename Slide<Frame>::Offset Slide<Frame>::offset_to(const Visit& visit, Vec3 there) const {
  return times(mesh_.frame.offset(there, visit.here), 1.0 / visit.scale);
}

/// Of the candidates that were listed the first of those that are worth most, if that is more than `best`, which it becomes; else their
/// number. By packs where that can be; that finds the same.
template <class Frame>
std::size_t Slide<Frame>::first_best(const Visit& visit, double& best) const {
  CandidateList& candidates = visit.scratch.candidates;
  if (list_kernel_ != nullptr && !visit.tangled) {
    CompositeSearch<Frame> task = aims_;
    task.star = lists_of(visit.scratch.star);
    const CompositeBest found = list_kernel_(task, candidates.view(), best);
    if (found.ready) {
      best = found.worth;
      return found.index;
    }
  }
  std::size_t first = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double value = visit.score(candidates.get<Offset>(i), best);
    if (value > best) best = value, first = i;
  }
  return first;
}

/// The place that the method chooses; the vertex's own where none is better.
template <class Frame>
double Slide<Frame>::search(const Visit& visit, const Stretch& stretch) const {
  const double before = stretch.beside.place_before, after = stretch.beside.place_after;
  switch (choice_.by) {
    case SlideChoice::By::Grid:
      return search_grid(visit, stretch);
    case SlideChoice::By::Mean:
      return stretch.place + choice_.relaxation * (0.5 * (before + after) - stretch.place);
    case SlideChoice::By::Compass:
      break;
  }
  const auto from_here = [&](double way) {
    const double place = stretch.place + way;
    if (way == 0.0) return visit.score({});
    return before < place && place < after ? visit.score(offset_to(visit, domain_->curves().at(visit.vertex, place))) : kNothing;
  };
  return stretch.place + compass_search<double>(from_here, 0.5 * (after - before));
}

template <class Frame>
double Slide<Frame>::search_grid(const Visit& visit, const Stretch& stretch) const {
  const int count = parameters_.grid_points * parameters_.grid_points;
  CandidateList& candidates = visit.scratch.candidates;
  std::vector<double>& places = visit.scratch.places;
  double best = stretch.place, objective = visit.score({}), omega = parameters_.omega;
  for (int level = 0; level < parameters_.levels; ++level) {
    const double width = omega * (stretch.beside.place_after - stretch.beside.place_before);
    candidates.clear(), places.clear();
    for (int i = 0; i < count; ++i) {
      const double place = best + width * (static_cast<double>(i) / (count - 1) - 0.5);
      if (!(stretch.beside.place_before < place && place < stretch.beside.place_after)) continue;
      candidates.add(offset_to(visit, domain_->curves().at(visit.vertex, place)));
      places.push_back(place);
    }
    if (const std::size_t found = first_best(visit, objective); found < places.size()) best = places[found];
    omega *= 2.0 / (count - 1);
  }
  return best;
}

template <class Frame>
bool Slide<Frame>::may_go(const Visit& visit, Vec3 target) const {
  return !choice_.must_gain || judge_.confirm(visit.positions, visit.vertex, target) == Confirmation::Gains;
}

template <class Frame>
bool Slide<Frame>::keeps_near(const Visit& visit, const Stretch& stretch, double place, Vec3 target) const {
  const auto deviation = [&](double at, Vec3 position) {
    return bound_->along_curve(visit.positions, visit.vertex, stretch.beside, at, position);
  };
  const double there = deviation(place, target);
  return there <= bound_->most() || there <= deviation(stretch.place, visit.here);
}

/// Where the vertex comes to stand at a place of its curve; nowhere if it may not.
template <class Frame>
std::optional<Vec3> Slide<Frame>::possible(const Visit& visit, const Stretch& stretch, double place) const {
  const Curves& curves = domain_->curves();
  const Vec3 target = curves.at(visit.vertex, place);
  // What rounding put elsewhere must still be between the neighbours.
  const auto landed = curves.place(visit.vertex, target);
  if (!landed || !curves.neighbours(visit.vertex, *landed, visit.positions)) return std::nullopt;
  if (!may_go(visit, target) || !keeps_near(visit, stretch, place, target)) return std::nullopt;
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
  return bound_->allows_faces(visit.positions, {visit.vertex, visit.here, target, here, there}, visit.scratch.room, visit.fit_now);
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
std::optional<Vec2<double>> Slide<Frame>::search_flat(const Visit& visit, const Tangent& tangent) const {
  if constexpr (!std::is_same_v<Frame, Curved>) {
    return std::nullopt;
  } else {
    if (flat_kernel_ == nullptr) return std::nullopt;
    Star<double>& flat = visit.scratch.flat;
    flat.triangles.clear();
    flat.quadrilaterals.clear();
    const auto from_above = [&](Vec3 p) { return tangent.plane.project(p); };
    for (const SurfaceTriangle& t : visit.scratch.star.triangles) {
      const Vec2<double> b = from_above(t.b), c = from_above(t.c);
      flat.triangles.push_back(cross(b, c) > 0.0 ? StarTriangle<double>{b, c, 1.0} : StarTriangle<double>{c, b, 1.0});
    }
    for (const SurfaceQuadrilateral& q : visit.scratch.star.quadrilaterals) {
      const Vec2<double> b = from_above(q.b), c = from_above(q.c), d = from_above(q.d);
      flat.quadrilaterals.push_back(cross(c, d - b) > 0.0 ? StarQuadrilateral<double>{b, c, d, 1.0}
                                                          : StarQuadrilateral<double>{d, c, b, 1.0});
    }
    CompositeSearch<Plane> task = flat_aims_;
    task.star = lists_of(flat);
    task.box = tangent.box;
    const CompositeFound<Plane> found = flat_kernel_(task);
    return found.ready ? std::optional(found.offset) : std::nullopt;
  }
}

/// The winner among places on the surface.
template <class Frame>
Vec2<double> Slide<Frame>::search_on_surface(const Visit& visit, const Tangent& tangent) const {
  const Facets& facets = domain_->faces().facets();
  const FacetWalks walks(facets, tangent.place.facet, tangent.plane, visit.here, kSteepest, visit.scratch.walks);
  if (choice_.by == SlideChoice::By::Grid) return search_grid(visit, tangent, walks);
  const auto worth_at = [&](Vec2<double> p) {
    if (p == Vec2<double>{}) return visit.score({});
    const auto found = walks.to(times(p, visit.scale));
    return found ? visit.score(offset_to(visit, facets.at(*found))) : kNothing;
  };
  double sum = 0.0, count = 0.0;
  for_neighbours_on_surface(visit, [&](Vec3 way) { sum += length(way), count += 1.0; });
  return compass_search<Vec2<double>>(worth_at, sum / (count * visit.scale));
}

/// As grid_search() has it; a level at once.
template <class Frame>
Vec2<double> Slide<Frame>::search_grid(const Visit& visit, const Tangent& tangent, const FacetWalks& walks) const {
  CandidateList& candidates = visit.scratch.candidates;
  std::vector<Vec2<double>>& steps = visit.scratch.steps;
  Vec2<double> best{};
  double objective = visit.score({}), omega = parameters_.omega;
  for (int level = 0; level < parameters_.levels; ++level) {
    const CandidateGrid<double> grid{best, times(tangent.box, omega), parameters_.grid_points};
    candidates.clear(), steps.clear();
    for (int i = 0; i < grid.points; ++i) {
      grid.for_slice(i, [&](int /*index*/, Vec2<double> step) {
        const auto found = step == Vec2<double>{} ? std::nullopt : walks.to(times(step, visit.scale));
        if (!found) return;  // or where it stands: no better than that
        candidates.add(offset_to(visit, domain_->faces().facets().at(*found)));
        steps.push_back(step);
      });
    }
    if (const std::size_t found = first_best(visit, objective); found < steps.size()) best = steps[found];
    omega *= 2.0 / (grid.points - 1);
  }
  return best;
}

/// Calls f(way) with the way to the other end of each edge of the surface at the vertex; each comes twice.
template <class Frame>
template <class F>
void Slide<Frame>::for_neighbours_on_surface(const Visit& visit, const F& f) const {
  const SlidingFaces& faces = domain_->faces();
  for (const Index face : faces.at(visit.vertex)) {
    const auto corners = faces.table().corners(face);
    const auto at = static_cast<std::size_t>(std::ranges::find(corners, visit.vertex) - corners.begin());
    for (const std::size_t steps : {std::size_t{1}, corners.size() - 1})
      f(visit.positions[corners[(at + steps) % corners.size()]] - visit.here);
  }
}

template <class Frame>
Vec2<double> Slide<Frame>::step_to_mean(const Visit& visit, const Tangent& tangent) const {
  Vec3 sum{};
  double count = 0.0;
  for_neighbours_on_surface(visit, [&](Vec3 way) { sum = sum + way, count += 1.0; });
  return times(tangent.plane.project(sum), choice_.relaxation / (count * visit.scale));
}

/// Where the vertex comes to stand a step away in the tangent plane, or half of it, and so on; nowhere if it may not.
template <class Frame>
std::optional<Vec3> Slide<Frame>::possible_on_surface(const Visit& visit, const Tangent& tangent, Vec2<double> step) const {
  const Facets& facets = domain_->faces().facets();
  for (int i = 0; i <= kHalvings && !(step == Vec2<double>{}); ++i, step = times(step, 0.5)) {
    const auto there = facets.walk(tangent.place.facet, tangent.plane, visit.here, times(step, visit.scale), kSteepest);
    if (!there) continue;
    Vec3 target = facets.at(*there);
    if (single_precision_) {
      target = {nearest_float(target.x), nearest_float(target.y), nearest_float(target.z)};
      if (!domain_->faces().place(visit.vertex, target)) continue;
    }
    if (!may_go(visit, target) || !fits(visit, target, &tangent.place, &*there)) continue;
    Found& found = found_[visit.vertex];
    found.place.facet = there->facet;  // where to look next time
    found.valid = false;
    return target;
  }
  return std::nullopt;
}

template <class Frame>
std::optional<FacetPlace> Slide<Frame>::place_on_surface(const Visit& visit) const {
  Found& found = found_[visit.vertex];
  if (found.valid && found.position == visit.here) return found.place;
  const auto place = domain_->faces().place(visit.vertex, visit.here, found.place.facet);
  found.valid = place.has_value();
  if (place) found.position = visit.here, found.place = *place;
  return place;
}

template <class Frame>
std::optional<Vec3> Slide<Frame>::on_surface(const Visit& visit) const {
  if constexpr (!std::is_same_v<Frame, Plane>) {
    const auto place = place_on_surface(visit);
    if (!place) return std::nullopt;
    const Vec3 normal = domain_->faces().facets().normal(*place);
    if (normal == Vec3{}) return std::nullopt;
    Tangent tangent{*place, tangent_plane(normal), {}};
    if (choice_.by == SlideChoice::By::Mean) return possible_on_surface(visit, tangent, step_to_mean(visit, tangent));
    tangent.box = box_of_star(mesh_, visit.positions, visit.vertex, tangent.plane, visit.scale);
    if (!visit.tangled && choice_.by == SlideChoice::By::Grid) {
      if (const auto step = search_flat(visit, tangent)) {
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
  static constexpr std::size_t kGrain = 32;
  void begin(const Sweep& /*sweep*/) {}
  [[nodiscard]] std::optional<Vec3> target(PositionView /*positions*/, Index /*vertex*/, Scratch& /*scratch*/) const {
    return std::nullopt;
  }
};
}  // namespace

std::unique_ptr<Smoother> make_surface_smoother(const SmoothingTask& task, CompositeObjective composite, SlideChoice choice) {
  return make_sliding_smoother<Curved>(task, NobodyIsFree{}, std::move(composite), choice);
}

}  // namespace dmoscope
