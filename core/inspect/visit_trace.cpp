#include "core/inspect/visit_trace.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/inspect/recorder.h"
#include "core/inspect/require_star.h"
#include "core/inspect/single_vertex_task.h"
#include "core/quality/metric_phrase.h"
#include "core/smooth/kernels/targets/target_visit.h"
#include "core/smooth/kernels/targets/tetrahedron_targets.h"
#include "core/smooth/methods/defined_search.h"
#include "core/smooth/methods/star_kernels.h"
#include "core/smooth/methods/volume_star_search.h"

namespace dmoscope {

namespace {

/// What the fast search compares: formulas::rank.
std::string rank_phrase(Metric metric) {
  switch (metric) {
    case Metric::MinAngle:
      return "squared sine of the smallest angle";
    case Metric::MaxAngle:
      return "tangent of half the angle outside the largest angle";
    case Metric::Rectangularity:
    case Metric::ScaledJacobian:
      return "squared " + metric_phrase(metric);
    default:
      return metric_phrase(metric);
  }
}

/// "mean ratio up to 0.7, beyond it 0.7 + density"
std::string both_phrase(const CompositeObjective& composite) {
  if (composite.is_single()) return metric_phrase(composite.first);
  const auto* metric = std::get_if<Metric>(&composite.second);
  const std::string second = metric != nullptr ? metric_phrase(*metric) : composite.raise_mean() ? "mean of the star" : "density";
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

/// One look at one vertex. Frame: Plane or Space.
template <Metric M, class Frame>
class Look {
 public:
  static constexpr bool kVolume = std::is_same_v<Frame, Space>;
  static constexpr bool kDefined = M == kDefinedMetric;
  using Offset = OffsetIn<Frame, double>;
  using Trace = VisitTraceIn<Offset>;

  Look(const InputMesh& input, PositionView positions, Metric metric, const SearchParameters& parameters, Index vertex,
       const std::optional<CompositeObjective>& composite, const Untangling& untangling, const std::optional<Guard>& guard)
      : input_(input),
        metric_(metric),
        mesh_(input.view<Frame>()),
        positions_(positions),
        parameters_(parameters),
        objective_(composite.value_or(single_objective(metric))),
        untangling_(untangling) {
    if (guard) objective_.guard = guard;
    trace_.vertex = vertex;
    trace_.metric = metric;
    if constexpr (kDefined) {
      judge_ = input.quality_context().judge(metric);
      star_judge_.emplace(defined_star_judge<Frame>(input, *judge_));
    }
    trace_.from = trace_.to = positions[vertex];
    trace_.by_corners = has_corners();
    trace_.before = trace_.after = state(trace_.from);
  }

  Trace run(bool fixed) {
    if (fixed)
      trace_.end = VisitEnd::Fixed;
    else if (untangling_.repair && trace_.before.jacobian > 0.0)
      trace_.end = VisitEnd::Waits;
    else if (!objective_.is_single())
      search_for_both(false);
    else if ((parameters_.precision == Precision::Double && !kDefined) || !search_fast())
      search_plainly();
    if (breaks_guard()) {
      trace_.fast = false;
      trace_.halvings = 0;
      trace_.to = trace_.from;
      search_for_both(true);
    }
    trace_.step = mesh_.frame.offset(trace_.to, trace_.from);
    if (trace_.end == VisitEnd::Moved) trace_.after = state(trace_.to);
    add_elements();
    return std::move(trace_);
  }

 private:
  /// As the fast smoothers do it: false where the star is the plain search's.
  bool search_fast() {
    if constexpr (kDefined)
      return (has_target_kernel(input_, metric_, parameters_) && search_by_targets()) || search_by_formula();
    else if constexpr (kVolume)
      return search_by_volume_kernel();
    else
      return search_by_lanes();
  }

  bool search_by_targets() {
    if constexpr (kVolume)
      return search_by_target_kernel();
    else
      return search_by_target_lanes();
  }

  /// The star by the statistics' formulas with the vertex at a place.
  [[nodiscard]] StarState state(Vec3 place) const {
    if constexpr (kDefined)
      return defined_star_state(*star_judge_, positions_, trace_.vertex, place);
    else
      return star_state<M>(mesh_, positions_, trace_.vertex, place);
  }

  /// Repeats the search of DefinedKernel. Its choice in level L is found by a search of L levels and not by one of L - 1.
  bool search_by_formula() requires(M == kDefinedMetric) {
    if (!(trace_.before.jacobian > 0.0)) return false;
    const DefinedSearch<Frame> search(*star_judge_, parameters_);
    typename DefinedSearch<Frame>::Scratch scratch;
    trace_.fast = !search.in_double();
    trace_.value_phrase = metric_phrase(metric_);
    const DefinedStar<Frame> star(*star_judge_, positions_, trace_.vertex);
    const auto find = [&](int levels) { return search.find(positions_, trace_.vertex, levels, scratch); };
    const auto start = find(0);
    Recorder<Offset> recorder(start.scale);
    recorder.begin(star.least({}));
    if (search.in_double())
      record_levels<double>(recorder, start.box, star, find);
    else
      record_levels<float>(recorder, start.box, star, find);
    take(std::move(recorder), [this](Offset offset) { return stored(offset); });
    end([this](Vec3 target) { return confirm(target); });
    return true;
  }
  template <class Real, class Find>
  void record_levels(Recorder<Offset>& recorder, Offset box, const DefinedStar<Frame>& star, const Find& find) {
    using Point = OffsetIn<Frame, Real>;
    const auto narrow = [](Offset p) {
      if constexpr (kVolume)
        return Point{static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)};
      else
        return Point{static_cast<Real>(p.x), static_cast<Real>(p.y)};
    };
    Point centre{};
    double omega = parameters_.omega;
    for (int level = 1; level <= parameters_.levels; ++level) {
      const CandidateGrid<Real, Point> grid{centre, times(narrow(box), static_cast<Real>(omega)), parameters_.grid_points};
      recorder.level(grid);
      for (int i = 0; i < grid.points; ++i)
        grid.for_slice(i, [&](int index, const Point& p) { recorder.candidate(index, p, star.least(point_of<double>(p))); });
      const Point found = narrow(find(level).offset);
      if (!(found == centre)) recorder.choose(found);
      centre = found;
      omega *= 2.0 / (parameters_.grid_points - 1);
    }
  }

  /// As LaneDmo does it.
  bool search_by_lanes() {
    const SingleVertexTask task(input_, positions_, parameters_, trace_.vertex);
    if (task.shapes->kind == StarShape::Kind::Alone) return false;
    Recorder<Offset> recorder(task.frame.scale);
    const auto outcome = FastVisit<M, Solo, Stars::All, SingleVertexTask>(task, 0, Solo{}).run(recorder);
    if (!outcome.ready) return false;
    trace_.fast = true;
    trace_.value_phrase = rank_phrase(metric_);
    take_from_lanes(std::move(recorder), task, outcome);
    return true;
  }
  template <class Outcome>
  void take_from_lanes(Recorder<Offset> recorder, const SingleVertexTask& task, const Outcome& outcome) {
    const auto place = [&](Offset offset) {
      // Exact: the offsets are floats times a power of two.
      const Displacement to = task.frame.displace(&trace_.from.x, static_cast<float>(offset.x * task.frame.inverse),
                                                  static_cast<float>(offset.y * task.frame.inverse));
      return Vec3{to.target[0], to.target[1], to.target[2]};
    };
    take(std::move(recorder), place);
    using visit_rules::Verdict;
    const Vec3 target{outcome.to.target[0], outcome.to.target[1], outcome.to.target[2]};
    end(target, outcome.verdict == Verdict::Move || (outcome.verdict == Verdict::MoveIfExact && confirm(target) == Confirmation::Gains));
  }

  /// As LaneDmo does it where elements have targets.
  bool search_by_target_lanes() {
    const TargetTable& targets = judge_->targets();
    if (has_crossed_targets(targets, static_cast<Index>(input_.mesh.elements.size()))) return search_by_target_lanes<true>(targets);
    return search_by_target_lanes<false>(targets);
  }
  template <bool Crossed>
  bool search_by_target_lanes(const TargetTable& targets) {
    const SingleVertexTask task(input_, positions_, parameters_, trace_.vertex);
    if (task.shapes->kind == StarShape::Kind::Alone) return false;
    std::vector<Index> others;
    std::vector<double> numbers;
    const StarShape shape = star_shape(input_.mesh, input_.topology, trace_.vertex, others);
    append_star_targets(targets, Crossed, input_.mesh, input_.topology, trace_.vertex, shape, others, numbers);
    Recorder<Offset> recorder(task.frame.scale);
    const auto outcome = TargetVisit<Crossed, SingleVertexTask>(task, 0, numbers.data()).run(recorder);
    if (!outcome.ready) return false;
    trace_.fast = true;
    trace_.value_phrase = metric_phrase(metric_);
    take_from_lanes(std::move(recorder), task, outcome);
    return true;
  }

  /// Repeats the search of FastVolumeKernel.
  bool search_by_volume_kernel() {
    StarIn<Frame, double> star;
    gather_star(MeshStar(mesh_, positions_, trace_.vertex), star);
    const Objective<M, false, double, Value::Metric, StarViewIn<Frame, double>> objective(star);
    return search_by_volume_kernel(VolumeStarSearch(M, parameters_), {}, objective);
  }
  /// Repeats the search of TargetVolumeKernel.
  bool search_by_target_kernel() {
    const auto star = mesh_.star(trace_.vertex);
    const TetrahedronTargets targets(judge_->targets(), input_.mesh, star);
    std::vector<Incidence> numbered(star.begin(), star.end());
    for (Index i = 0; i < numbered.size(); ++i) numbered[i].element = i;
    if (!targets.fit(numbered)) return false;
    const DefinedStar<Frame> defined_star(*star_judge_, positions_, trace_.vertex);
    return search_by_volume_kernel(VolumeStarSearch(parameters_, targets.crossed()), {numbered.data(), targets.numbers()},
                                   [&](Vec3 p) { return defined_star.least(p); });
  }
  /// What the kernel chose in level L is what it finds in L levels and does not find in L - 1. objective(p): what a place is worth.
  template <class Objective>
  bool search_by_volume_kernel(const VolumeStarSearch& search, const VolumeTargets& targets, const Objective& objective) {
    if (untangling_.looks_inside() && has_inverted(mesh_, positions_, trace_.vertex)) return false;
    const IndexedStars stars(input_, trace_.vertex);
    VolumeStarSearch::Points points;
    const auto find = [&](int levels) { return search.find(stars.of(trace_.vertex), positions_, trace_.vertex, levels, points, targets); };
    if (!find(0).ready) return false;
    trace_.fast = true;
    trace_.value_phrase = metric_phrase(metric_);
    Recorder<Offset> recorder(points.scale);
    recorder.begin(objective(Vec3{}));
    Vec3Of<float> centre{};
    double omega = parameters_.omega;
    for (int level = 1; level <= parameters_.levels; ++level) {
      const CandidateGrid<float, Vec3Of<float>> grid{centre, times(points.narrow_box, static_cast<float>(omega)), parameters_.grid_points};
      recorder.level(grid);
      for (int i = 0; i < grid.points; ++i)
        grid.for_slice(i, [&](int index, Vec3Of<float> p) { recorder.candidate(index, p, objective(Vec3{p.x, p.y, p.z})); });
      const Vec3Of<float> found = find(level).offset;
      if (!(found == centre)) recorder.choose(found);
      centre = found;
      omega *= 2.0 / (parameters_.grid_points - 1);
    }
    take(std::move(recorder), [this](Offset offset) { return stored(offset); });
    end([this](Vec3 target) { return confirm(target); });
    return true;
  }

  /// As the reference does it.
  void search_plainly() {
    Recorder<Offset> recorder(1.0);
    if constexpr (kDefined) {
      const DefinedStar<Frame> star(*star_judge_, positions_, trace_.vertex);
      recorder = Recorder<Offset>(star.scale());
      (void)search_star<M>(star.view(), star.star().box, parameters_, untangling_, Solo{}, recorder);
    } else {
      StarIn<Frame, double> star;
      gather_star(MeshStar(mesh_, positions_, trace_.vertex), star);
      recorder = Recorder<Offset>(star.scale);
      (void)search_star<M>(StarViewIn<Frame, double>(star), star.box, parameters_, untangling_, Solo{}, recorder);
    }
    trace_.untangling = !(recorder.here > 0.0);
    trace_.value_phrase = (trace_.untangling ? untangling_phrase(kVolume, untangling_) : "") + metric_phrase(metric_);
    take(std::move(recorder), [this](Offset offset) { return stored(offset); });
    end([this](Vec3 target) { return confirm(target); });
  }

  /// Repeats the plain search for two aims, which finds the winner of the packs.
  void search_for_both(bool guarded) {
    StarJudge<Frame> judge(input_, objective_);
    judge.begin({.untangling = untangling_});
    StarIn<Frame, double> star;
    judge.gather(positions_, trace_.vertex, star);
    Recorder<Offset> recorder(star.scale);
    trace_.combined = !objective_.is_single();
    trace_.untangling = judge.is_tangled(star);
    if (!untangling_.repair || trace_.untangling) {
      const Offset middle = trace_.untangling ? middle_of<Offset>(StarViewIn<Frame, double>(star)) : Offset{};
      (void)grid_search<double>(judge.score_of(star, positions_, trace_.vertex, trace_.untangling, guarded), star.box, parameters_,
                                recorder, Solo{}, trace_.untangling ? &middle : nullptr);
    }
    trace_.value_phrase = (trace_.untangling ? untangling_phrase(kVolume, untangling_) : "") + both_phrase(objective_);
    take(std::move(recorder), [this](Offset offset) { return stored(offset); });
    end([&](Vec3 target) {
      const Confirmation found = judge.confirm(positions_, trace_.vertex, target);
      const bool kept = !guarded || found != Confirmation::Gains || judge.keeps_guard(positions_, trace_.vertex, target);
      return kept ? found : Confirmation::TooFar;
    });
  }
  /// Whether the guard alone does not let the vertex go where it would.
  [[nodiscard]] bool breaks_guard() const {
    if (trace_.end != VisitEnd::Moved || !objective_.guard) return false;
    return !StarJudge<Frame>(input_, objective_).keeps_guard(positions_, trace_.vertex, trace_.to);
  }

  [[nodiscard]] bool has_corners() const {
    const auto is_cornered = [this](const Incidence& at) { return mesh_.corners_of(at.element).size() > 4; };
    return kVolume && std::ranges::any_of(mesh_.star(trace_.vertex), is_cornered);
  }

  /// Where an offset leads as the smoothers in double store it.
  [[nodiscard]] Vec3 stored(Offset offset) const { return displaced(mesh_.frame, trace_.from, offset, input_.mesh.single_precision); }
  [[nodiscard]] Confirmation confirm(Vec3 target) const {
    if constexpr (kDefined)
      return defined_confirm_at(*star_judge_, positions_, trace_.vertex, target, untangling_);
    else
      return confirm_at<M>(mesh_, positions_, trace_.vertex, target, untangling_);
  }

  /// place(offset): where the vertex would be stored.
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

  void add_elements() {
    for (const Incidence& incidence : mesh_.star(trace_.vertex)) {
      ElementChange change{incidence.element};
      const auto judge = [&](Vec3 place, double& quality, bool& inverted) {
        const auto at = [&](Index v) { return v == trace_.vertex ? place : positions_[v]; };
        visit_shape(mesh_.frame_of(incidence.element), mesh_.corners_of(incidence.element), at, [&](const auto& shape) {
          if constexpr (kDefined)
            quality = star_judge_->quality({incidence.element, kNoIndex}, positions_, trace_.vertex, place);
          else
            quality = evaluate<M>(shape);
          inverted = least_jacobian(shape) <= 0.0;
        });
      };
      judge(trace_.from, change.before, change.inverted_before);
      judge(trace_.to, change.after, change.inverted_after);
      trace_.elements.push_back(change);
    }
  }

  const InputMesh& input_;
  Metric metric_;
  std::shared_ptr<const DefinedJudge> judge_;
  std::optional<DefinedStarJudge<Frame>> star_judge_;  // of a metric that is not built in
  MeshView<Frame> mesh_;
  PositionView positions_;
  const SearchParameters& parameters_;
  CompositeObjective objective_;
  const Untangling& untangling_;
  Trace trace_;
};

/// Whether the vertex is fixed. Throws UsageError when there is nothing to trace.
bool require_traceable(const InputMesh& input, Shape shape, std::span<const std::uint8_t> fixed, Metric metric,
                       const SearchParameters& parameters, Index vertex) {
  require_vertex(input, vertex, shape);
  validate(parameters);
  if (!defined_around(input, metric, vertex))
    throw UsageError(fmt::format("{} is not defined for all elements around vertex {}", info(metric).name, vertex));
  return fixed[vertex] != 0 || input.topology.star(vertex).empty();
}

/// How a visit that moved its vertex changed its star.
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
  const auto look = [&]<Metric M>() {
    return Look<M, Plane>(input, positions, metric, parameters, vertex, composite, untangling, guard).run(is_fixed);
  };
  return is_built_in(metric) ? formulas::with_planar_metric(metric, look) : look.template operator()<kDefinedMetric>();
}

VolumeTrace trace_volume_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed, Metric metric,
                               const SearchParameters& parameters, Index vertex, const std::optional<CompositeObjective>& composite,
                               const Untangling& untangling, const std::optional<Guard>& guard) {
  const bool is_fixed = require_traceable(input, Shape::Volume, fixed, metric, parameters, vertex);
  const auto look = [&]<Metric M>() {
    return Look<M, Space>(input, positions, metric, parameters, vertex, composite, untangling, guard).run(is_fixed);
  };
  return is_built_in(metric) ? formulas::with_volume_metric(metric, look) : look.template operator()<kDefinedMetric>();
}

}  // namespace dmoscope
