#include "core/inspect/surface_trace.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/inspect/recorder.h"
#include "core/quality/metric_phrase.h"
#include "core/reference/deviation_bound.h"
#include "core/reference/overlay.h"
#include "core/smooth/methods/dmo.h"

namespace dmoscope {

namespace {

/// Traces the visit of one vertex. Frame: Space or Curved.
template <class Frame>
class SurfaceLook {
 public:
  SurfaceLook(const SmoothingTask& task, std::span<const Vec3> positions, Index vertex, const Sweep& sweep, CompositeObjective composite)
      : task_(task),
        objective_(std::move(composite)),
        positions_(positions),
        vertex_(vertex),
        here_(positions[vertex]),
        sweep_(sweep),
        facets_(task.domain->faces().facets()),
        mesh_(task.input->view<Frame>()),
        judge_(*task.input, objective_) {}

  SurfaceVisit run(bool combined) {
    VisitTrace& trace = visit_.trace;
    trace.vertex = vertex_;
    trace.metric = task_.metric;
    trace.combined = combined;
    trace.from = trace.to = here_;
    trace.before = trace.after = state(here_);
    trace.value_phrase = combined ? "its two aims" : metric_phrase(task_.metric);
    Recorder<Vec2<double>> recorder;
    const auto to = watch_visit<Frame>(task_, objective_, sweep_, positions_, vertex_, recorder);
    trace.untangling = recorder.search().tangled;
    const auto place = task_.domain->faces().place(vertex_, here_);
    const Vec3 normal = place ? facets_.normal(*place) : Vec3{};
    if (place && !(normal == Vec3{})) {
      visit_.grid.plane = tangent_plane(normal);
      recorder.give(trace, [&](Vec2<double> offset) {
        const auto found = walk(*place, offset, kSteepest);
        return found ? quality_of(state(facets_.at(*found))) : 0.0;
      });
      look_at_surface(*place);
    }
    settle(to);
    trace.elements = element_changes<Frame>(*task_.input, positions_, trace);
    trace.by_corners = has_corners(mesh_, vertex_);
    return std::move(visit_);
  }

 private:
  [[nodiscard]] StarState state(Vec3 at) const { return judge_.state(task_.metric, positions_, vertex_, at); }

  [[nodiscard]] std::optional<FacetPlace> walk(const FacetPlace& stands, Vec2<double> way, double least_cosine) const {
    return facets_.walk(stands.facet, visit_.grid.plane, here_, way, least_cosine);
  }
  /// Finds the candidates' places on the surface, and their fates.
  void look_at_surface(const FacetPlace& stands) {
    Overlay overlay(*task_.domain, room_);
    const Fit now = overlay.star(positions_, vertex_, here_, &stands, kNoFit);
    const Fit bound{task_.max_deviation, task_.max_deviation, kLeastCosine};
    for (const TracedLevel& level : visit_.trace.levels) {
      SurfaceGrid::Level& on_surface = visit_.grid.levels.emplace_back();
      for (const Vec2<double> offset : level.offsets) {
        const auto found = walk(stands, offset, kSteepest);
        CandidateFate fate = CandidateFate::Counts;
        if (!found)
          fate = walk(stands, offset, -1.0) ? CandidateFate::TurnedAway : CandidateFate::Feature;
        else if (!(now.deviation == kNoFit.deviation && !task_.domain->faces().are_own()))
          fate = fate_of(overlay.star(positions_, vertex_, facets_.at(*found), &*found, kNoFit), now);
        else if (!overlay.keeps_what_lies(positions_, vertex_, here_, &stands, facets_.at(*found), &*found, bound))
          fate = CandidateFate::Deviates;
        on_surface.fates.push_back(fate);
        on_surface.places.push_back(found ? facets_.at(*found) - here_ : visit_.grid.plane.lift(offset));
      }
    }
  }
  /// Fate of a candidate that lies on the surface: it counts if it is as near as the bound, or no worse than the vertex's present place.
  [[nodiscard]] CandidateFate fate_of(const Fit& there, const Fit& now) const {
    const bool lay = now.deviation < kNoFit.deviation, lies = there.deviation < kNoFit.deviation;
    if (!lies || there.least_cosine < (lay ? std::min(kLeastCosine, now.least_cosine) : kLeastCosine)) return CandidateFate::Leans;
    const double most = lay ? std::max(task_.max_deviation, now.deviation) : task_.max_deviation,
                 most_other = lay ? std::max(task_.max_deviation, now.other_split) : task_.max_deviation;
    return there.deviation <= most && there.other_split <= most_other ? CandidateFate::Counts : CandidateFate::Deviates;
  }
  /// Ends the visit at the place to which the vertex goes.
  void settle(const std::optional<Vec3>& to) {
    VisitTrace& trace = visit_.trace;
    trace.to = to.value_or(here_);
    trace.step = visit_.grid.plane.project(trace.to - here_);
    if (!(trace.to == here_)) {
      trace.end = VisitEnd::Moved;
      trace.after = state(trace.to);
    } else if (sweep_.untangling.repair && trace.before.jacobian > 0.0) {
      trace.end = VisitEnd::Waits;
    } else if (trace.found == Vec2<double>{}) {
      trace.end = VisitEnd::NothingFound;
    } else {
      const CandidateFate fate = fate_of_best();
      trace.end = fate == CandidateFate::Deviates ? VisitEnd::Deviates
                  : fate == CandidateFate::Leans  ? VisitEnd::Leans
                                                  : VisitEnd::NotConfirmed;
    }
  }
  [[nodiscard]] CandidateFate fate_of_best() const {
    for (std::size_t k = visit_.trace.levels.size(); k-- > 0;)
      if (const auto best = visit_.trace.levels[k].best) return visit_.grid.levels[k].fates[static_cast<std::size_t>(*best)];
    return CandidateFate::Counts;
  }

  const SmoothingTask& task_;
  CompositeObjective objective_;
  std::span<const Vec3> positions_;
  Index vertex_;
  Vec3 here_;
  Sweep sweep_;
  const Facets& facets_;
  MeshView<Frame> mesh_;
  StarJudge<Frame> judge_;
  OverlayRoom room_;
  SurfaceVisit visit_;
};

}  // namespace

std::string_view phrase(CandidateFate fate) noexcept {
  constexpr std::array<std::string_view, 5> kPhrases{"", "it lies beyond a feature edge, or where the surface ends",
                                                     "the surface is turned away there",
                                                     "with the vertex there, faces would leave the input by more than the bound",
                                                     "with the vertex there, faces would lean over the input by more than 60 degrees"};
  return kPhrases[static_cast<std::size_t>(fate)];
}

SurfaceVisit trace_surface_visit(const SmoothingTask& task, std::span<const Vec3> positions, Index vertex, const Sweep& sweep,
                                 const std::optional<CompositeObjective>& composite) {
  if (!task.domain || vertex >= task.input->mesh.vertex_count() || !task.domain->on_surface(vertex))
    throw UsageError(fmt::format("vertex {} does not slide on a surface", vertex));
  const CompositeObjective aims = composite.value_or(objective_of(task));
  if (task.input->is_volume()) return SurfaceLook<Space>(task, positions, vertex, sweep, aims).run(composite.has_value());
  return SurfaceLook<Curved>(task, positions, vertex, sweep, aims).run(composite.has_value());
}

}  // namespace dmoscope
