#include "core/inspect/visit_trace.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/inspect/recorder.h"
#include "core/inspect/require_star.h"
#include "core/inspect/single_vertex_task.h"
#include "core/quality/formulas.h"
#include "core/quality/metric_phrase.h"
#include "core/smooth/kernels/targets/target_visit.h"
#include "core/smooth/methods/dmo.h"
#include "core/smooth/methods/star_kernels.h"

namespace dmoscope {

namespace {

/// Phrase for the value that the fast search compares: formulas::rank.
std::string rank_phrase(Metric metric) {
  if (!is_built_in(metric)) return metric_phrase(metric);
  return formulas::with_metric(metric, [&]<Metric M>() {
    if constexpr (requires { formulas::Formula<M>::kRankPhrase; })
      return std::string(formulas::Formula<M>::kRankPhrase);
    else
      return metric_phrase(metric);
  });
}

/// Phrase for a composite objective: "mean ratio up to 0.7, beyond it 0.7 + density".
std::string both_phrase(const CompositeObjective& composite) {
  if (composite.is_single()) return metric_phrase(composite.first);
  const auto* metric = std::get_if<Metric>(&composite.second);
  const std::string second = metric != nullptr        ? metric_phrase(*metric)
                             : composite.raise_mean() ? "mean of the star"
                                                      : std::string(std::get<std::shared_ptr<const PlaceAim>>(composite.second)->name());
  return fmt::format("{} {} {:.6g}, {} {:.6g} + {}", metric_phrase(composite.first), composite.raise_mean() ? "below" : "up to",
                     composite.threshold, composite.raise_mean() ? "from there on" : "beyond it", composite.threshold, second);
}

std::string untangling_phrase(bool volume, const Untangling& rule) {
  const char* of = volume ? "corners'" : "elements'";
  if (rule.repair) return fmt::format("least of the {} Jacobians, squeezed into -1 to 0; once all are positive the ", of);
  if (rule.attempt)
    return fmt::format(
        "mean of the {} Jacobians less 0.2, each taken up to 0.2, squeezed into -1 to 0 (-1e9 where more elements would be inverted, the "
        "least Jacobian fell, or a metric fell below the mesh's minimum); once all are positive the ",
        of);
  return "half of (least quality of the sound elements less 1), less the number of inverted ones (-1e9 where a sound one would be "
         "inverted, "
         "or the least quality fell); once all are sound the ";
}

/// Tells a watcher of a search by lanes. See grid_search().
struct LaneTrace {
  VisitWatcher& watcher;
  double scale;  // mesh units

  template <class Real>
  [[nodiscard]] Vec3 told(Vec2<Real> p) const {
    return in_space(times(point_of<double>(p), scale));
  }
  void begin(float here) const { watcher.begin({.here = here, .at_start = here, .single = true}); }
  void start(const Candidate<float>& /*centre of the first grid*/) const {}
  void level(const CandidateGrid<float>& grid) const { watcher.level(told(grid.centre), told(grid.size), grid.points); }
  void candidate(int /*index*/, Vec2<float> at, float value) const { watcher.candidate(told(at), double{value}); }
  void found(const Candidate<float>& best) const { watcher.found(told(best.offset)); }
};

/// Traces the visit of one vertex. Frame: Plane or Space.
template <class Frame>
class Look {
 public:
  static constexpr bool kVolume = std::is_same_v<Frame, Space>;
  using Offset = OffsetIn<Frame, double>;
  using Trace = VisitTraceIn<Offset>;

  Look(const InputMesh& input, PositionView positions, Metric metric, const SearchParameters& parameters, Index vertex,
       const std::optional<CompositeObjective>& composite, const Untangling& untangling, const std::optional<Guard>& guard)
      : input_(input), mesh_(input.view<Frame>()), positions_(positions), untangling_(untangling), judge_(input, single_objective(metric)) {
    objective_ = composite.value_or(single_objective(metric));
    if (guard) objective_.guard = guard;
    task_.input = {std::shared_ptr<const InputMesh>(), &input};
    task_.metric = metric;
    task_.search = parameters;
    trace_.vertex = vertex;
    trace_.metric = metric;
    trace_.from = trace_.to = positions[vertex];
    trace_.by_corners = has_corners(mesh_, vertex);
    trace_.before = trace_.after = state(trace_.from);
  }

  Trace run(bool fixed) {
    if (fixed)
      trace_.end = VisitEnd::Fixed;
    else if (untangling_.repair && trace_.before.jacobian > 0.0)
      trace_.end = VisitEnd::Waits;
    else
      search();
    trace_.step = mesh_.frame.offset(trace_.to, trace_.from);
    if (trace_.end == VisitEnd::Moved) trace_.after = state(trace_.to);
    trace_.elements = element_changes<Frame>(input_, positions_, trace_);
    return std::move(trace_);
  }

 private:
  using Lanes = std::optional<std::optional<Vec3>>;  // none: the star is not for lanes; else the place to which they move it

  void search() {
    Lanes by_lanes;
    if constexpr (!kVolume)
      if (objective_.is_single() && task_.search.precision == Precision::Float && !untangling_.repair) by_lanes = search_by_lanes();
    const auto to = by_lanes ? *by_lanes : watch({});
    const VisitWatcher::Begin& search = recorder_.search();
    if (by_lanes && search.single) {
      trace_.value_phrase = rank_phrase(trace_.metric);
      recorder_.give(trace_, [&](Offset offset) { return quality_of(state(by_lanes_at(offset))); });
    } else {
      trace_.value_phrase = (search.tangled ? untangling_phrase(kVolume, untangling_) : "") + both_phrase(objective_);
      recorder_.give(trace_, [&](Offset offset) {
        return quality_of(state(displaced(mesh_.frame, trace_.from, offset, input_.mesh.single_precision)));
      });
    }
    trace_.fast = search.single;
    trace_.combined = !objective_.is_single();
    trace_.untangling = search.tangled;
    trace_.to = to.value_or(trace_.from);
    trace_.end = trace_.found == Offset{} ? VisitEnd::NothingFound : to ? VisitEnd::Moved : VisitEnd::NotConfirmed;
  }
  [[nodiscard]] std::optional<Vec3> watch(const std::optional<Vec3>& by_lanes) {
    return watch_visit<Frame>(task_, objective_, {.untangling = untangling_}, positions_, trace_.vertex, recorder_, by_lanes);
  }

  /// State of the star by the statistics' formulas with the vertex at a place.
  [[nodiscard]] StarState state(Vec3 place) const { return judge_.state(trace_.metric, positions_, trace_.vertex, place); }

  Lanes search_by_lanes() {
    if (is_built_in(trace_.metric))
      return formulas::with_planar_metric(trace_.metric, [this]<Metric M>() {
        return this->run_lane(
            [](const SingleVertexTask& task) { return FastVisit<M, Solo, Stars::All, SingleVertexTask>(task, 0, Solo{}); });
      });
    if (!has_target_kernel(input_, trace_.metric, task_.search)) return {};
    const auto judge = input_.quality_context().judge(trace_.metric);
    const TargetTable& targets = judge->targets();
    if (has_crossed_targets(targets, static_cast<Index>(input_.mesh.elements.size()))) return search_by_target_lanes<true>(targets);
    return search_by_target_lanes<false>(targets);
  }
  template <bool Crossed>
  Lanes search_by_target_lanes(const TargetTable& targets) {
    std::vector<Index> others;
    std::vector<double> numbers;
    const StarShape shape = star_shape(input_.mesh, input_.topology, trace_.vertex, others);
    if (shape.kind == StarShape::Kind::Alone) return {};
    append_star_targets(targets, Crossed, input_.mesh, input_.topology, trace_.vertex, shape, others, numbers);
    return run_lane([&](const SingleVertexTask& task) { return TargetVisit<Crossed, SingleVertexTask>(task, 0, numbers.data()); });
  }
  /// Repeats the visit of a lane. make_visit(task): that visit.
  template <class MakeVisit>
  Lanes run_lane(const MakeVisit& make_visit) {
    const SingleVertexTask task(input_, positions_, task_.search, trace_.vertex);
    if (task.shapes->kind == StarShape::Kind::Alone) return {};
    const auto outcome = make_visit(task).run(LaneTrace{recorder_, task.frame.scale});
    if (!outcome.ready) return {};
    using visit_rules::Verdict;
    const Vec3 target{outcome.to.target[0], outcome.to.target[1], outcome.to.target[2]};
    if (outcome.verdict == Verdict::Stay) return std::optional<Vec3>();
    return outcome.verdict == Verdict::Move && !objective_.guard ? std::optional(target) : watch(target);
  }
  /// Position in which lanes store an offset, of which they have the floats: it is those times a power of two.
  [[nodiscard]] Vec3 by_lanes_at(Offset offset) const {
    const SearchFrame frame = make_search_frame(input_);
    const Displacement to =
        frame.displace(&trace_.from.x, static_cast<float>(offset.x * frame.inverse), static_cast<float>(offset.y * frame.inverse));
    return {to.target[0], to.target[1], to.target[2]};
  }

  const InputMesh& input_;
  MeshView<Frame> mesh_;
  PositionView positions_;
  const Untangling& untangling_;
  StarJudge<Frame> judge_;  // judge of states by the metric alone
  CompositeObjective objective_;
  SmoothingTask task_;
  Recorder<Offset> recorder_;
  Trace trace_;
};

/// Whether the vertex is fixed. Throws UsageError if there is nothing to trace.
bool require_traceable(const InputMesh& input, Shape shape, std::span<const std::uint8_t> fixed, Metric metric,
                       const SearchParameters& parameters, Index vertex) {
  require_vertex(input, vertex, shape);
  validate(parameters);
  if (!defined_around(input, metric, vertex))
    throw UsageError(fmt::format("{} is not defined for all elements around vertex {}", info(metric).name, vertex));
  return fixed[vertex] != 0 || input.topology.star(vertex).empty();
}

/// Phrase on how a visit that moved its vertex changed its star.
std::string moved_phrase(const VisitSummary& visit) {
  const StarState &before = visit.before, &after = visit.after;
  if (visit.combined && !visit.untangling)
    return fmt::format("moved for two aims: {} of its star {:.4g} -> {:.4g}", visit.worst_phrase(), before.quality, after.quality);
  if (before.jacobian > 0.0)
    return fmt::format("moved: {} of its star {:.4g} -> {:.4g}", visit.worst_phrase(), before.quality, after.quality);
  if (after.jacobian > 0.0) return fmt::format("moved: untangled its star, whose {} is {:.4g} now", visit.worst_phrase(), after.quality);
  if (after.inverted < before.inverted)
    return fmt::format("moved: inverted elements of its star {} -> {}", before.inverted, after.inverted);
  if (after.jacobian == before.jacobian)
    return fmt::format("moved: its star stays tangled; least quality of its sound elements {:.4g} -> {:.4g}", before.sound, after.sound);
  return fmt::format("moved: smallest Jacobian of its tangled star {:.4g} -> {:.4g}", before.jacobian, after.jacobian);
}

}  // namespace

std::string VisitSummary::sentence() const {
  switch (end) {
    case VisitEnd::Moved:
      if (halvings == 0) return moved_phrase(*this);
      return fmt::format("{}; 1/{} of the way, since all of it would invert an element inside", moved_phrase(*this), 1 << halvings);
    case VisitEnd::NothingFound:
      if (combined) return "stays: no candidate is better for its two aims than where it stands";
      return "stays: no candidate is better than where it stands";
    case VisitEnd::NotConfirmed:
      if (halvings > 0) return "stays: on the way to the best candidate, an element would become inverted inside";
      return "stays: the best candidate gains nothing when judged exactly";
    case VisitEnd::Deviates:
      return "stays: with it at the best candidate, faces would leave the input by more than the bound";
    case VisitEnd::Leans:
      return "stays: with it at the best candidate, faces would lean over the input by more than 60 degrees";
    case VisitEnd::Waits:
      return "waits: none of its elements is inverted, and this iteration only takes back vertices whose place alone is wrong";
    case VisitEnd::Fixed:
      break;
  }
  return "fixed: it is not searched";
}

VisitTrace trace_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed, Metric metric,
                       const SearchParameters& parameters, Index vertex, const std::optional<CompositeObjective>& composite,
                       const Untangling& untangling, const std::optional<Guard>& guard) {
  const bool is_fixed = require_traceable(input, Shape::Planar, fixed, metric, parameters, vertex);
  return Look<Plane>(input, positions, metric, parameters, vertex, composite, untangling, guard).run(is_fixed);
}

VolumeTrace trace_volume_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed, Metric metric,
                               const SearchParameters& parameters, Index vertex, const std::optional<CompositeObjective>& composite,
                               const Untangling& untangling, const std::optional<Guard>& guard) {
  const bool is_fixed = require_traceable(input, Shape::Volume, fixed, metric, parameters, vertex);
  return Look<Space>(input, positions, metric, parameters, vertex, composite, untangling, guard).run(is_fixed);
}

}  // namespace dmoscope
