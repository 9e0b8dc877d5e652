#include "core/joint/sliding_path.h"

#include <algorithm>
#include <cmath>

#include "core/base/rounding.h"

namespace dmoscope {

namespace {

constexpr double kSameWay = 1e-12;    // difference of cosines: two straight ways that go on without a corner
constexpr double kNearCorner = 1e-9;  // share of a straight way: a vertex that ends nearer to its end than that ends there
constexpr double kSmallStep = 1e-3;   // share of an edge: step by which room is looked for
constexpr double kOpenStep = 0.03;    // share of a facet's size: such a step on a surface, once something stopped a vertex
constexpr double kDrawn = 1e-3;       // share of a vertex's force that a stop must resist to be reported
constexpr int kHalvings = 8;

template <std::size_t N>
double inner(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0.0;
  for (std::size_t r = 0; r < N; ++r) sum += a[r] * b[r];
  return sum;
}

}  // namespace

template <int D>
SlidingPath<D>::SlidingPath(const JointMesh<D>& mesh, const LocalProblem<D>& local, std::span<const Vec3> positions, const Domain& domain,
                            const DeviationBound& limit)
    : mesh_(mesh), domain_(domain), curves_(domain.curves()), limit_(limit), scale_(local.scale) {
  const auto free = local.free();
  ways_.assign(free.size(), free_way());
  bound_.assign(free.size(), 0);
  for (Index i = 0; i < free.size(); ++i) {
    if (!domain.slides(free[i])) continue;
    any_ = true;
    bound_[i] = 1;
    ways_[i] = {};  // a vertex stays where nothing better is known
    if (domain.on_curve(free[i]))
      add_slider(i, free[i], positions[free[i]]);
    else
      add_surface_slider(i, free[i], positions[free[i]]);
  }
  std::erase_if(sliders_, [&](const Slider& s) { return !curves_.neighbours(s.vertex, s.begin_place, positions); });
  std::vector<std::size_t> slider_of(positions.size(), kNone);
  for (std::size_t s = 0; s < sliders_.size(); ++s) slider_of[sliders_[s].vertex] = s;
  for (std::size_t s = 0; s < sliders_.size(); ++s) add_edges(s, positions, slider_of);
  if (!domain.faces().any() || (sliders_.empty() && on_surface_.empty())) return;
  faces_ = std::make_unique<FaceWatch>(domain, limit, positions);
  of_vertex_.assign(positions.size(), kNoIndex);
  Index number = 0;
  for (const Slider& s : sliders_) {
    faces_->add(s.vertex, std::nullopt);
    of_vertex_[s.vertex] = number++;
  }
  for (const SurfaceSlider& s : on_surface_) {
    faces_->add(s.vertex, s.begin.place);
    of_vertex_[s.vertex] = number++;
  }
}

template <int D>
void SlidingPath<D>::add_surface_slider(Index free, Index vertex, Vec3 position) {
  const auto place = domain_.faces().place(vertex, position);
  if (!place) return;
  const SurfaceSlider::Stand stand{*place, position};
  on_surface_.push_back({.free = free, .vertex = vertex, .begin = stand, .now = stand, .trial = stand, .best = stand});
}

template <int D>
void SlidingPath<D>::hold() {
  sliders_.clear();
  edges_.clear();
  on_surface_.clear();
  faces_.reset();
}

template <int D>
void SlidingPath<D>::add_slider(Index free, Index vertex, Vec3 position) {
  const auto place = curves_.place(vertex, position);
  if (!place) return;
  const Stand stand{*place, 0.0, position};
  sliders_.push_back(
      Slider{.free = free, .vertex = vertex, .begin = position, .begin_place = *place, .now = stand, .trial = stand, .best = stand});
}

/// Adds the edge behind a slider, and the one before it where no other slider adds that.
template <int D>
void SlidingPath<D>::add_edges(std::size_t slider, std::span<const Vec3> positions, std::span<const std::size_t> slider_of) {
  Slider& s = sliders_[slider];
  const Curves::Neighbours beside = *curves_.neighbours(s.vertex, s.begin_place, positions);
  const auto add = [&](Edge edge) {
    edge.limit =
        std::max(limit_.most(), curves_.deviation(s.vertex, edge.place_from, edge.place_from + edge.gap, edge.at_from, edge.at_to));
    edges_.push_back(edge);
    return edges_.size() - 1;
  };
  const std::size_t next = slider_of[beside.after];
  s.after = add({.from = slider,
                 .to = next,
                 .place_from = s.begin_place,
                 .gap = beside.place_after - s.begin_place,
                 .at_from = s.begin,
                 .at_to = positions[beside.after]});
  if (next != kNone) sliders_[next].before = s.after;
  if (slider_of[beside.before] == kNone)
    s.before = add({.to = slider,
                    .place_from = place_within(s.vertex, beside.place_before),
                    .gap = s.begin_place - beside.place_before,
                    .at_from = positions[beside.before],
                    .at_to = s.begin});
}

template <int D>
double SlidingPath<D>::place_within(Index vertex, double place) const {
  const double period = curves_.period(vertex);
  if (period > 0.0 && place < 0.0) return place + period;
  return period > 0.0 && place >= period ? place - period : place;
}

// ---- allowed places ----

template <int D>
double SlidingPath<D>::deviation(const Edge& edge, Index vertex, const Stand& from, const Stand& to) const {
  const double first = edge.from == kNone ? edge.place_from : place_within(vertex, from.place), gap = edge.gap + to.gone - from.gone;
  return curves_.deviation(vertex, first, first + gap, edge.from == kNone ? edge.at_from : from.position,
                           edge.to == kNone ? edge.at_to : to.position);
}

/// Returns whether, in the trial, an edge's ends are still in order and it keeps near the curve.
template <int D>
bool SlidingPath<D>::keeps(const Edge& edge) const {
  const Stand stays{};
  const Stand& from = edge.from == kNone ? stays : sliders_[edge.from].trial;
  const Stand& to = edge.to == kNone ? stays : sliders_[edge.to].trial;
  if (!(edge.gap + to.gone - from.gone > 0.0)) return false;
  return deviation(edge, sliders_[edge.from == kNone ? edge.to : edge.from].vertex, from, to) <= edge.limit;
}

/// Returns whether an edge may have one of its ends elsewhere.
template <int D>
bool SlidingPath<D>::edge_allows(const Edge& edge, std::size_t moved, const Stand& there) const {
  const Stand stays{};
  const Stand& from = edge.from == moved ? there : edge.from == kNone ? stays : sliders_[edge.from].now;
  const Stand& to = edge.to == moved ? there : edge.to == kNone ? stays : sliders_[edge.to].now;
  return deviation(edge, sliders_[moved].vertex, from, to) <= edge.limit;
}

/// Position as the file would hold it: stored in floats it is beside a feature edge, and small faces reach across that then.
template <int D>
Vec3 SlidingPath<D>::as_stored(const Slider& slider, const Stand& stand) const {
  return stand.gone == 0.0 ? slider.begin : curves_.at(slider.vertex, place_within(slider.vertex, stand.place));
}

/// Returns whether there is room for a small step.
template <int D>
bool SlidingPath<D>::is_open(const Slider& slider, bool forwards) {
  const std::size_t self = static_cast<std::size_t>(&slider - sliders_.data());
  const Edge& ahead = edges_[forwards ? slider.after : slider.before];
  const double gone_from = ahead.from == kNone ? 0.0 : sliders_[ahead.from].now.gone;
  const double gone_to = ahead.to == kNone ? 0.0 : sliders_[ahead.to].now.gone;
  const double step = kSmallStep * (ahead.gap + gone_to - gone_from);
  const double place = place_within(slider.vertex, slider.now.place + (forwards ? step : -step));
  const Stand there{place, slider.now.gone + (forwards ? step : -step), curves_.point_at(slider.vertex, place)};
  return edge_allows(edges_[slider.before], self, there) && edge_allows(edges_[slider.after], self, there) &&
         (!faces_ || faces_->allows(slider.vertex, curves_.at(slider.vertex, place), nullptr));
}

/// Chooses a vertex's way on a surface. A blocked way stays blocked as long as its force leads there, and no step of some length is
/// possible. A vertex that was blocked on another way, too, stays meanwhile.
template <int D>
void SlidingPath<D>::choose_on_surface(SurfaceSlider& slider, Vec3 force) {
  const Facets& facets = domain_.faces().facets();
  slider.normal = facets.normal(slider.now.place);
  slider.stopped = false;
  ways_[slider.free] = {};
  if (slider.normal == Vec3{}) return;
  const auto level = [&](Vec3 way) { return way - dot(way, slider.normal) * slider.normal; };
  const auto forbid = [&](Vec3 direction) {
    const std::array<double, 3> n{direction.x, direction.y, direction.z};
    Way& way = ways_[slider.free];
    for (std::size_t i = 0; i < kD * kD; ++i) way[i] -= n[i / kD] * n[i % kD];
  };
  const Vec3 drawn = level(force), way = slider.held ? drawn : level(slider.blocked);
  const double size = length(way);
  const auto is_open = [&] {
    if (!(size > 0.0) || !(dot(drawn, way) > 0.0)) return true;
    const double step = std::max(slider.blocked_step, kOpenStep * std::sqrt(facets.twice_area(slider.now.place.facet)));
    const auto there = stand_on_surface(facets, slider.now, slider.normal, (step / size) * way);
    return there && faces_->allows(slider.vertex, there->position, &there->place);
  };
  if (!(slider.blocked == Vec3{}) && is_open()) {
    slider.blocked = {};
    slider.held = false;
  }
  slider.stopped = !(slider.blocked == Vec3{}) && dot(drawn, way) > kDrawn * length(force) * size;
  if (slider.held) return;
  ways_[slider.free] = free_way();
  forbid(slider.normal);
  if (!(slider.blocked == Vec3{})) forbid(slider.blocked = (1.0 / size) * way);
}

template <int D>
typename SlidingPath<D>::Way SlidingPath<D>::free_way() {
  Way all{};
  for (std::size_t r = 0; r < kD; ++r) all[r * kD + r] = 1.0;
  return all;
}

template <int D>
void SlidingPath<D>::choose(std::span<const double> forces) {
  if (faces_) {
    for (const Slider& s : sliders_) faces_->put(s.vertex, as_stored(s, s.now));
    for (const SurfaceSlider& s : on_surface_) faces_->put(s.vertex, s.now.position);
  }
  if constexpr (D == 3)
    for (SurfaceSlider& s : on_surface_) choose_on_surface(s, {forces[3 * s.free], forces[3 * s.free + 1], forces[3 * s.free + 2]});
  for (Slider& s : sliders_) {
    for (std::size_t r = 0; r < kD; ++r) s.force[r] = forces[s.free * kD + r];
    const auto forwards = curves_.straight(s.vertex, s.now.place, true), backwards = curves_.straight(s.vertex, s.now.place, false);
    Way& way = ways_[s.free] = {};
    s.stopped = false;
    s.way = {};
    if (!forwards || !backwards) continue;
    const Place ahead = mesh_.in_frame(forwards->way), behind = mesh_.in_frame(backwards->way);
    const bool corner = dot(forwards->way, backwards->way) > kSameWay - 1.0;
    const double drawn_ahead = inner(s.force, ahead), drawn_behind = inner(s.force, behind);
    const bool open_ahead = is_open(s, true), open_behind = is_open(s, false);
    const double noticed = kDrawn * std::sqrt(inner(s.force, s.force));
    s.one_sided = corner || !open_ahead || !open_behind;
    s.runs_forwards = !s.one_sided || (open_ahead && drawn_ahead > 0.0 && !(open_behind && drawn_behind > drawn_ahead));
    s.stopped = (!open_ahead && drawn_ahead > noticed) || (!open_behind && drawn_behind > noticed);
    if (!s.runs_forwards && !(open_behind && drawn_behind > 0.0)) continue;
    s.way = s.runs_forwards ? ahead : behind;
    const double square = inner(s.way, s.way);
    for (std::size_t i = 0; i < kD * kD; ++i) way[i] = s.way[i / kD] * s.way[i % kD] / square;
  }
}

// ---- trials ----

/// Returns whether its force draws a vertex at a corner of its curve back from the next straight way, more than from the one on which it
/// comes.
template <int D>
bool SlidingPath<D>::draws_back(const Slider& slider, Vec3 way, Vec3 next) const {
  const double cosine = dot(way, next);
  if (cosine > 1.0 - kSameWay) return false;
  return inner(slider.force, mesh_.in_frame(next)) < cosine * inner(slider.force, mesh_.in_frame(way));
}

template <int D>
void SlidingPath<D>::walk(Slider& slider, double length) const {
  const bool forwards = length > 0.0;
  double left = std::fabs(length);
  slider.trial = slider.now;
  while (left > 0.0) {
    const auto straight = curves_.straight(slider.vertex, slider.trial.place, forwards);
    if (!straight) break;
    if (left < (1.0 - kNearCorner) * straight->distance) {
      slider.trial.place += forwards ? left : -left;
      left = 0.0;
      break;
    }
    slider.trial.place = straight->end;
    left = std::max(0.0, left - straight->distance);
    const auto next = curves_.straight(slider.vertex, straight->end, forwards);
    if (!next || draws_back(slider, straight->way, next->way)) break;
  }
  const double gone = std::fabs(length) - left;
  slider.trial.gone += forwards ? gone : -gone;
  if (gone > 0.0) slider.trial.position = curves_.point_at(slider.vertex, slider.trial.place);
}

template <int D>
bool SlidingPath<D>::put_back(const std::vector<Place>& from, std::vector<Place>& trial) {
  for (Slider& s : sliders_) {
    Place step = trial[s.free];
    for (std::size_t r = 0; r < kD; ++r) step[r] -= from[s.free][r];
    const double square = inner(s.way, s.way);
    s.asked = square > 0.0 ? inner(step, s.way) / (square * scale_) : 0.0;
    if (s.one_sided) s.asked = std::max(s.asked, 0.0);
    if (!s.runs_forwards) s.asked = -s.asked;
    walk(s, s.asked);
  }
  for (SurfaceSlider& s : on_surface_) {
    Place step = trial[s.free];
    for (std::size_t r = 0; r < kD; ++r) step[r] -= from[s.free][r];
    s.wished = s.asked = (1.0 / scale_) * mesh_.lifted(step);
    walk_on_surface(domain_.faces().facets(), s);
  }
  shorten();
  for (std::size_t v = 0; v < bound_.size(); ++v)
    if (bound_[v] != 0) trial[v] = from[v];
  for (const Slider& s : sliders_) {
    trial[s.free] = mesh_.in_frame(mesh_.difference(s.trial.position, s.begin));
    for (double& x : trial[s.free]) x *= scale_;
  }
  for (const SurfaceSlider& s : on_surface_) {
    trial[s.free] = mesh_.in_frame(mesh_.difference(s.trial.position, s.begin.position));
    for (double& x : trial[s.free]) x *= scale_;
  }
  return true;
}

/// Shortens the way of sliders whose edges or faces would leave the input too far, or turn over.
template <int D>
void SlidingPath<D>::shorten() {
  if (faces_) unsure_.assign(sliders_.size() + on_surface_.size(), 1);
  for (int round = 0;; ++round) {
    const std::vector<std::uint8_t> marked = find_strayed();
    if (std::ranges::find(marked, 1) == marked.end()) return;
    shorten_marked(marked, round >= kHalvings);
  }
}

/// Marks, by their number, the sliders that could go less far: whether they must.
template <int D>
std::vector<std::uint8_t> SlidingPath<D>::find_strayed() {
  std::vector<std::uint8_t> marked(sliders_.size() + on_surface_.size(), 0);
  const auto mark = [&](std::size_t i) {
    const bool goes = i < sliders_.size() ? sliders_[i].asked != 0.0 : !(on_surface_[i - sliders_.size()].asked == Vec3{});
    if (goes) marked[i] = 1;
  };
  for (const Edge& edge : edges_) {
    if (keeps(edge)) continue;
    for (const std::size_t end : {edge.from, edge.to})
      if (end != kNone) mark(end);
  }
  if (!faces_) return marked;
  for (const Slider& s : sliders_) faces_->put(s.vertex, as_stored(s, s.trial));
  for (const SurfaceSlider& s : on_surface_) faces_->put(s.vertex, s.trial.position);
  const auto check = [&](std::size_t i, Index vertex, Vec3 begin, Vec3 there, const FacetPlace* beneath) {
    if (unsure_[i] == 0) return;
    unsure_[i] = 0;
    if (there == begin || faces_->allows(vertex, there, beneath)) return;
    unsure_[i] = 1;
    for (const Index v : faces_->around(vertex))
      if (of_vertex_[v] != kNoIndex) mark(of_vertex_[v]);
  };
  for (std::size_t i = 0; i < sliders_.size(); ++i) check(i, sliders_[i].vertex, sliders_[i].begin, sliders_[i].trial.position, nullptr);
  for (std::size_t i = 0; i < on_surface_.size(); ++i) {
    const SurfaceSlider& s = on_surface_[i];
    check(sliders_.size() + i, s.vertex, s.begin.position, s.trial.position, &s.trial.place);
  }
  return marked;
}

/// Shortens the way of marked sliders by half, or all of it.
template <int D>
void SlidingPath<D>::shorten_marked(const std::vector<std::uint8_t>& marked, bool all) {
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i] == 0) continue;
    if (i < sliders_.size()) {
      sliders_[i].asked *= all ? 0.0 : 0.5;
      walk(sliders_[i], sliders_[i].asked);
    } else {
      SurfaceSlider& s = on_surface_[i - sliders_.size()];
      s.asked = all ? Vec3{} : 0.5 * s.asked;
      walk_on_surface(domain_.faces().facets(), s);
    }
    if (!faces_) continue;
    const Index vertex = i < sliders_.size() ? sliders_[i].vertex : on_surface_[i - sliders_.size()].vertex;
    for (const Index v : faces_->around(vertex))
      if (of_vertex_[v] != kNoIndex) unsure_[of_vertex_[v]] = 1;
  }
}

template <int D>
void SlidingPath<D>::take() {
  for (Slider& s : sliders_) s.now = s.trial;
  for (SurfaceSlider& s : on_surface_) {
    s.now = s.trial;
    const double wished = length(s.wished);
    if (!(length(s.asked) < 0.5 * wished)) continue;
    s.held = !(s.blocked == Vec3{});
    s.blocked = (1.0 / wished) * s.wished;
    s.blocked_step = 0.5 * wished;
  }
}

template <int D>
void SlidingPath<D>::keep_best() {
  for (Slider& s : sliders_) s.best = s.now;
  for (SurfaceSlider& s : on_surface_) s.best = s.now;
}

// ---- outcome ----

template <int D>
std::vector<Index> SlidingPath<D>::stopped() const {
  std::vector<Index> vertices;
  for (const Slider& s : sliders_)
    if (s.stopped) vertices.push_back(s.vertex);
  for (const SurfaceSlider& s : on_surface_)
    if (s.stopped) vertices.push_back(s.vertex);
  std::ranges::sort(vertices);
  return vertices;
}

/// Place so far along its curve from where it began.
template <int D>
typename SlidingPath<D>::Stand SlidingPath<D>::stand_at(const Slider& slider, double gone) const {
  double place = gone == slider.best.gone ? slider.best.place : slider.begin_place + gone;
  const double period = curves_.period(slider.vertex);
  if (period > 0.0) place -= period * std::floor(place / period);
  return {place, gone, curves_.at(slider.vertex, place)};
}

/// Returns whether a stored position is still on the curve and between the neighbours, and the edges there near it: rounding may have moved
/// it.
template <int D>
bool SlidingPath<D>::may_stand(const Slider& slider, std::span<const Vec3> positions) const {
  const auto place = curves_.place(slider.vertex, positions[slider.vertex]);
  if (!place) return false;
  const auto beside = curves_.neighbours(slider.vertex, *place, positions);
  if (!beside) return false;
  const Vec3 here = positions[slider.vertex];
  return curves_.deviation(slider.vertex, beside->place_before, *place, positions[beside->before], here) <= edges_[slider.before].limit &&
         curves_.deviation(slider.vertex, *place, beside->place_after, here, positions[beside->after]) <= edges_[slider.after].limit;
}

template <int D>
bool SlidingPath<D>::may_stand(const SurfaceSlider& slider, Vec3 position) {
  const auto place = domain_.faces().place(slider.vertex, position);
  return place && faces_->allows(slider.vertex, position, &*place);
}

/// Position a share of the way along a surface; none where that leads nowhere.
template <int D>
std::optional<Vec3> SlidingPath<D>::target(const SurfaceSlider& slider, double share) const {
  Vec3 there = slider.best.position;
  if (share < 1.0) {
    const Facets& facets = domain_.faces().facets();
    const Vec3 normal = facets.normal(slider.begin.place);
    if (normal == Vec3{}) return std::nullopt;
    const auto stand = stand_on_surface(facets, slider.begin, normal, share * (there - slider.begin.position));
    if (!stand) return std::nullopt;
    there = stand->position;
  }
  if (!mesh_.input().mesh.single_precision) return there;
  return Vec3{nearest_float(there.x), nearest_float(there.y), nearest_float(there.z)};
}

template <int D>
std::size_t SlidingPath<D>::settle(double share, std::span<const Index> free, std::span<Vec3> positions, std::span<Vec3> targets) {
  std::vector<const Slider*> on_curves;
  std::vector<const SurfaceSlider*> on_surfaces;
  std::size_t stayed = 0;
  for (const Slider& s : sliders_) {
    targets[s.free] = s.best.gone == 0.0 ? s.begin : stand_at(s, share * s.best.gone).position;
    if (s.best.gone != 0.0) on_curves.push_back(&s);
  }
  for (const SurfaceSlider& s : on_surface_) {
    const bool moves = !(s.best.position == s.begin.position);
    const auto there = moves ? target(s, share) : std::nullopt;
    targets[s.free] = there.value_or(s.begin.position);
    if (there) on_surfaces.push_back(&s);
    stayed += moves && !there ? 1 : 0;
  }
  for (std::size_t i = 0; i < free.size(); ++i) std::swap(positions[free[i]], targets[i]);
  if (faces_)
    for (const Index v : free) faces_->put(v, positions[v]);
  const auto back = [&](Index vertex, Vec3 begin) {
    positions[vertex] = begin;
    if (faces_) faces_->put(vertex, begin);
    ++stayed;
    return true;
  };
  // Repeats until nothing changes: a vertex that goes back may be in the way of another.
  for (std::size_t before = stayed + 1; before != stayed;) {
    before = stayed;
    std::erase_if(on_curves, [&](const Slider* s) {
      const bool may = may_stand(*s, positions) && (!faces_ || faces_->allows(s->vertex, positions[s->vertex], nullptr));
      return !may && back(s->vertex, s->begin);
    });
    std::erase_if(on_surfaces,
                  [&](const SurfaceSlider* s) { return !may_stand(*s, positions[s->vertex]) && back(s->vertex, s->begin.position); });
  }
  for (std::size_t i = 0; i < free.size(); ++i) std::swap(positions[free[i]], targets[i]);
  return stayed;
}

template class SlidingPath<2>;
template class SlidingPath<3>;

}  // namespace dmoscope
