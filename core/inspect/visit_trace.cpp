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
#include "core/smooth/kernels/targets/tetrahedron_targets.h"
#include "core/smooth/methods/defined_search.h"
#include "core/smooth/methods/star_kernels.h"
#include "core/smooth/methods/volume_star_search.h"

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

CompositeObjective with_guard(CompositeObjective objective, const std::optional<Guard>& guard) {
  if (guard) objective.guard = guard;
  return objective;
}

/// Traces the visit of one vertex. Frame: Plane or Space.
template <class Frame>
class Look {
 public:
  static constexpr bool kVolume = std::is_same_v<Frame, Space>;
  using Offset = OffsetIn<Frame, double>;
  using Trace = VisitTraceIn<Offset>;

  Look(const InputMesh& input, PositionView positions, Metric metric, const SearchParameters& parameters, Index vertex,
       const std::optional<CompositeObjective>& composite, const Untangling& untangling, const std::optional<Guard>& guard)
      : input_(input),
        metric_(metric),
        mesh_(input.view<Frame>()),
        positions_(positions),
        parameters_(parameters),
        untangling_(untangling),
        judge_(input, with_guard(composite.value_or(single_objective(metric)), guard)) {
    judge_.begin({.untangling = untangling});
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
  void search() {
    judge_.gather(positions_, trace_.vertex, star_);
    const bool plain = !judge_.composite().is_single() || (parameters_.precision == Precision::Double && is_built_in(metric_));
    if (plain || !search_fast()) search_plainly(false);
    if (trace_.end != VisitEnd::Moved || judge_.keeps_guard(positions_, trace_.vertex, trace_.to)) return;
    trace_.fast = false;
    trace_.halvings = 0;
    trace_.to = trace_.from;
    search_plainly(true);
  }

  /// Repeats the kernel's search for the objective. False: the star is left to the plain search.
  bool search_fast() {
    if (!is_built_in(metric_)) {
      const auto judge = input_.quality_context().judge(metric_);
      return (has_target_kernel(input_, metric_, parameters_) && search_by_targets(judge->targets())) || search_by_formula(*judge);
    }
    if constexpr (kVolume)
      return search_by_volume_kernel(VolumeStarSearch(metric_, parameters_), {});
    else
      return formulas::with_planar_metric(metric_, [this]<Metric M>() {
        return search_by_lanes(rank_phrase(metric_), [](const SingleVertexTask& task) {
          return FastVisit<M, Solo, Stars::All, SingleVertexTask>(task, 0, Solo{});
        });
      });
  }

  bool search_by_targets(const TargetTable& targets) {
    const auto star = mesh_.star(trace_.vertex);
    if constexpr (kVolume) {
      const TetrahedronTargets of_star(targets, input_.mesh, star);
      std::vector<Incidence> numbered(star.begin(), star.end());
      for (Index i = 0; i < numbered.size(); ++i) numbered[i].element = i;
      return of_star.fit(numbered) &&
             search_by_volume_kernel(VolumeStarSearch(parameters_, of_star.crossed()), {numbered.data(), of_star.numbers()});
    } else {
      if (has_crossed_targets(targets, static_cast<Index>(input_.mesh.elements.size()))) return search_by_target_lanes<true>(targets);
      return search_by_target_lanes<false>(targets);
    }
  }

  /// State of the star by the statistics' formulas with the vertex at a place.
  [[nodiscard]] StarState state(Vec3 place) const { return judge_.state(metric_, positions_, trace_.vertex, place); }

  bool search_by_formula(const DefinedJudge& judge) {
    if (!(trace_.before.jacobian > 0.0)) return false;
    const auto star_judge = defined_star_judge<Frame>(input_, judge);
    const DefinedSearch<Frame> search(star_judge, parameters_);
    typename DefinedSearch<Frame>::Scratch scratch;
    trace_.fast = !search.in_double();
    const auto by_levels = [&]<class Real>() {
      const auto find = [&](int levels) { return search.find(positions_, trace_.vertex, levels, scratch); };
      const auto start = find(0);
      record_levels(start.scale, point_of<Real>(start.box), [&](int levels) { return point_of<Real>(find(levels).offset); });
    };
    if (search.in_double())
      by_levels.template operator()<double>();
    else
      by_levels.template operator()<float>();
    return true;
  }
  bool search_by_volume_kernel(const VolumeStarSearch& search, const VolumeTargets& targets) {
    if (untangling_.looks_inside() && has_inverted(mesh_, positions_, trace_.vertex)) return false;
    const IndexedStars stars(input_, trace_.vertex);
    VolumeStarSearch::Points points;
    const auto find = [&](int levels) { return search.find(stars.of(trace_.vertex), positions_, trace_.vertex, levels, points, targets); };
    if (!find(0).ready) return false;
    trace_.fast = true;
    record_levels(points.scale, points.narrow_box, [&](int levels) { return find(levels).offset; });
    return true;
  }
  /// Records a search that reports no candidates: its choice in level L is what it finds in L levels and not in L - 1. find(levels): an
  /// offset, in units of `scale`, as the search rounds it.
  template <class Point, class Find>
  void record_levels(double scale, Point box, const Find& find) {
    using Real = decltype(box.x);
    trace_.value_phrase = metric_phrase(metric_);
    const auto score = judge_.score_of(star_, positions_, trace_.vertex, false);
    Recorder<Offset> recorder(scale);
    recorder.begin(score(Offset{}));
    Point centre{};
    double omega = parameters_.omega;
    for (int level = 1; level <= parameters_.levels; ++level) {
      const CandidateGrid<Real, Point> grid{centre, times(box, static_cast<Real>(omega)), parameters_.grid_points};
      recorder.level(grid);
      for (int i = 0; i < grid.points; ++i)
        grid.for_slice(i, [&](int index, const Point& p) { recorder.candidate(index, p, score(point_of<double>(p))); });
      const Point found = find(level);
      if (!(found == centre)) recorder.choose(found);
      centre = found;
      omega *= 2.0 / (parameters_.grid_points - 1);
    }
    take(std::move(recorder));
    end([this](Vec3 target) { return confirm(target); });
  }

  template <bool Crossed>
  bool search_by_target_lanes(const TargetTable& targets) {
    std::vector<Index> others;
    std::vector<double> numbers;
    const StarShape shape = star_shape(input_.mesh, input_.topology, trace_.vertex, others);
    if (shape.kind == StarShape::Kind::Alone) return false;
    append_star_targets(targets, Crossed, input_.mesh, input_.topology, trace_.vertex, shape, others, numbers);
    return search_by_lanes(metric_phrase(metric_),
                           [&](const SingleVertexTask& task) { return TargetVisit<Crossed, SingleVertexTask>(task, 0, numbers.data()); });
  }
  /// Repeats a search by lanes. make_visit(task): the visit that a lane runs.
  template <class MakeVisit>
  bool search_by_lanes(std::string value_phrase, const MakeVisit& make_visit) {
    const SingleVertexTask task(input_, positions_, parameters_, trace_.vertex);
    if (task.shapes->kind == StarShape::Kind::Alone) return false;
    Recorder<Offset> recorder(task.frame.scale);
    const auto outcome = make_visit(task).run(recorder);
    if (!outcome.ready) return false;
    trace_.fast = true;
    trace_.value_phrase = std::move(value_phrase);
    take(std::move(recorder), [&](Offset offset) {
      // Recovers the floats exactly, since the offsets are floats times a power of two.
      const Displacement to = task.frame.displace(&trace_.from.x, static_cast<float>(offset.x * task.frame.inverse),
                                                  static_cast<float>(offset.y * task.frame.inverse));
      return Vec3{to.target[0], to.target[1], to.target[2]};
    });
    using visit_rules::Verdict;
    const Vec3 target{outcome.to.target[0], outcome.to.target[1], outcome.to.target[2]};
    end(target, outcome.verdict == Verdict::Move || (outcome.verdict == Verdict::MoveIfExact && confirm(target) == Confirmation::Gains));
    return true;
  }

  /// Repeats the plain search, which finds the winner of the packs. `guarded`: see StarScore.
  void search_plainly(bool guarded) {
    const CompositeObjective& objective = judge_.composite();
    Recorder<Offset> recorder(star_.scale);
    trace_.combined = !objective.is_single();
    trace_.untangling = judge_.is_tangled(star_);
    if (!untangling_.repair || trace_.untangling) {
      const Offset middle = trace_.untangling ? middle_of<Offset>(JudgedStarView<Frame>(star_)) : Offset{};
      (void)grid_search<double>(judge_.score_of(star_, positions_, trace_.vertex, trace_.untangling, guarded), star_.box, parameters_,
                                recorder, Solo{}, trace_.untangling ? &middle : nullptr);
    }
    trace_.value_phrase = (trace_.untangling ? untangling_phrase(kVolume, untangling_) : "") + both_phrase(objective);
    take(std::move(recorder));
    end([&](Vec3 target) {
      const Confirmation found = confirm(target);
      const bool kept = !guarded || found != Confirmation::Gains || judge_.keeps_guard(positions_, trace_.vertex, target);
      return kept ? found : Confirmation::TooFar;
    });
  }

  /// Position for an offset, as the smoothers in double store it.
  [[nodiscard]] Vec3 stored(Offset offset) const { return displaced(mesh_.frame, trace_.from, offset, input_.mesh.single_precision); }
  [[nodiscard]] Confirmation confirm(Vec3 target) const { return judge_.confirm(positions_, trace_.vertex, target); }

  void take(Recorder<Offset> recorder) {
    take(std::move(recorder), [this](Offset offset) { return stored(offset); });
  }
  /// Takes over a recording. place(offset): position in which the vertex would be stored.
  template <class Place>
  void take(Recorder<Offset> recorder, const Place& place) {
    trace_.value_here = recorder.here;
    trace_.levels = std::move(recorder.levels);
    trace_.found = trace_.start = recorder.started;
    trace_.value_at_start = recorder.at_start;
    for (TracedLevelIn<Offset>& level : trace_.levels) {
      level.quality.reserve(level.offsets.size());
      for (const Offset& offset : level.offsets) level.quality.push_back(quality_of(state(place(offset))));
      if (level.best) trace_.found = level.at(*level.best);
    }
  }

  /// Ends the visit at the longest step that confirm(place) allows, as RuleMesh::moved_if() moves the vertex.
  template <class Confirm>
  void end(const Confirm& confirm) {
    const auto halves = [&](Vec3 target) {
      const Confirmation found = confirm(target);
      trace_.halvings += found == Confirmation::TooFar ? 1 : 0;
      return found;
    };
    const ConfirmedMove move = confirmed_move(
        trace_.found, [this](Offset step) { return stored(step); }, halves);
    end(move.to, move.gains);
  }
  void end(Vec3 target, bool moves) {
    if (trace_.found == Offset{})
      trace_.end = VisitEnd::NothingFound;
    else if (!moves)
      trace_.end = VisitEnd::NotConfirmed;
    else
      trace_.end = VisitEnd::Moved, trace_.to = target;
  }

  const InputMesh& input_;
  Metric metric_;
  MeshView<Frame> mesh_;
  PositionView positions_;
  const SearchParameters& parameters_;
  const Untangling& untangling_;
  StarJudge<Frame> judge_;
  JudgedStar<Frame> star_;
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
