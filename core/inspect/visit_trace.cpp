#include "core/inspect/visit_trace.h"

#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/inspect/require_star.h"
#include "core/smooth/fast_visit.h"

namespace dmoscope {

namespace {

/// Keeps what a search tells, in mesh units.
class Recorder {
 public:
  explicit Recorder(double scale) : scale_(scale) {}

  template <class Real>
  void begin(const Real& objective) {
    here = static_cast<double>(objective);
    best_ = here;
  }
  template <class Real>
  void level(const CandidateGrid<Real>& grid) {
    TracedLevel& level = levels.emplace_back();
    level.centre = in_mesh_units(grid.centre);
    level.size = in_mesh_units(grid.size);
    level.points = grid.points;
  }
  template <class Real>
  void candidate(int /*index*/, Vec2<Real> offset, Real objective) {
    levels.back().offsets.push_back(in_mesh_units(offset));
    levels.back().values.push_back(static_cast<double>(objective));
  }
  template <class Real>
  void found(const Candidate<Real>& best) {
    if (static_cast<double>(best.objective) > best_) levels.back().best = index_of(in_mesh_units(best.offset));
    best_ = static_cast<double>(best.objective);
  }

  std::vector<TracedLevel> levels;
  double here = 0.0;

 private:
  template <class Real>
  [[nodiscard]] Vec2<double> in_mesh_units(Vec2<Real> offset) const {
    return {static_cast<double>(offset.x) * scale_, static_cast<double>(offset.y) * scale_};
  }
  /// Of a candidate of this level, by its very bits.
  [[nodiscard]] std::optional<int> index_of(Vec2<double> offset) const {
    const auto& all = levels.back().offsets;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].x == offset.x && all[i].y == offset.y) return static_cast<int>(i);
    return std::nullopt;
  }

  double scale_;
  double best_ = 0.0;
};

/// One vertex's star as FastVisit wants it: the vertex is rank 0, its ring the ranks that follow.
class LoneTask {
 public:
  LoneTask(const InputMesh& input, PositionView positions, const SearchParameters& search_parameters, Index vertex)
      : frame(make_search_frame(input)), parameters(search_parameters) {
    shape_ = star_shape(input.mesh, input.topology, vertex, ranks_);
    positions_.push_back(positions[vertex]);
    for (Index& other : ranks_) {
      positions_.push_back(positions[other]);
      other = static_cast<Index>(positions_.size() - 1);
    }
    shapes = &shape_;
    others = ranks_.data();
    ranked = positions_.data();
  }
  LoneTask(const LoneTask&) = delete;
  LoneTask& operator=(const LoneTask&) = delete;

  // What FastVisit reads.
  const StarShape* shapes;
  const Index* others;
  const Vec3* ranked;
  SearchFrame frame;
  SearchParameters parameters;

 private:
  StarShape shape_;
  std::vector<Index> ranks_;
  std::vector<Vec3> positions_;
};

std::string metric_phrase(Metric metric) {
  std::string title(info(metric).title);
  title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  return title;
}

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
std::string both_phrase(const Aims& aims) {
  const auto* metric = std::get_if<Metric>(&aims.second);
  const std::string second = metric != nullptr ? metric_phrase(*metric) : aims.raise_mean() ? "mean of the star" : "density";
  return fmt::format("{} {} {:.6g}, {} {:.6g} + {}", metric_phrase(aims.first), aims.raise_mean() ? "below" : "up to", aims.threshold,
                     aims.raise_mean() ? "from there on" : "beyond it", aims.threshold, second);
}

/// One look at one vertex.
template <Metric M>
class Look {
 public:
  Look(const InputMesh& input, PositionView positions, const SearchParameters& parameters, Index vertex, const std::optional<Aims>& aims)
      : input_(input), mesh_(input.planar_view()), positions_(positions), parameters_(parameters), aims_(aims) {
    trace_.vertex = vertex;
    trace_.metric = M;
    trace_.from = trace_.to = positions[vertex];
    trace_.before = trace_.after = star_state<M>(mesh_, positions_, vertex, trace_.from);
  }

  VisitTrace run(bool fixed) {
    if (fixed)
      trace_.end = VisitEnd::Fixed;
    else if (aims_)
      search_for_both();
    else if (parameters_.precision == Precision::Double || !search_fast())
      search_plainly();
    trace_.step = mesh_.frame.project(trace_.to - trace_.from);
    if (trace_.end == VisitEnd::Moved) trace_.after = star_state<M>(mesh_, positions_, trace_.vertex, trace_.to);
    add_elements();
    return std::move(trace_);
  }

 private:
  /// As LaneDmo does it: false where the star is the plain search's.
  bool search_fast() {
    const LoneTask task(input_, positions_, parameters_, trace_.vertex);
    if (task.shapes->kind == StarShape::Kind::Alone) return false;
    Recorder recorder(task.frame.scale);
    const auto outcome = FastVisit<M, Solo, Stars::All, LoneTask>(task, 0, Solo{}).run(recorder);
    if (!outcome.ready) return false;
    trace_.fast = true;
    trace_.value_phrase = rank_phrase(M);
    const auto place = [&](Vec2<double> offset) {
      // Exact: the offsets are floats times a power of two.
      const Displacement to = task.frame.displace(&trace_.from.x, static_cast<float>(offset.x * task.frame.inverse),
                                                  static_cast<float>(offset.y * task.frame.inverse));
      return Vec3{to.target[0], to.target[1], to.target[2]};
    };
    take(std::move(recorder), place);
    using visit_rules::Verdict;
    const Vec3 target{outcome.to.target[0], outcome.to.target[1], outcome.to.target[2]};
    end(target, outcome.verdict == Verdict::Move || (outcome.verdict == Verdict::MoveIfExact && gains(target)));
    return true;
  }

  /// As the reference does it.
  void search_plainly() {
    Star<double> star;
    gather_star(MeshStar<Plane>(mesh_, positions_, trace_.vertex), star);
    Recorder recorder(star.scale);
    (void)search_star<M>(StarView<double>(star), star.box, parameters_, Solo{}, recorder);
    trace_.untangling = !(recorder.here > 0.0);
    trace_.value_phrase = trace_.untangling ? "smallest normalised Jacobian, once positive the " + metric_phrase(M) : metric_phrase(M);
    const auto place = [&](Vec2<double> offset) { return displaced(mesh_.frame, trace_.from, offset, input_.mesh.single_precision); };
    take(std::move(recorder), place);
    const Vec3 target = place(trace_.found);
    end(target, gains(target));
  }

  /// As RuleSmoother does it with a CombinedSearch.
  void search_for_both() {
    Star<double> star;
    gather_star(MeshStar<Plane>(mesh_, positions_, trace_.vertex), star);
    Recorder recorder(star.scale);
    const CombinedSearch search(input_, *aims_, parameters_);
    trace_.combined = true;
    trace_.untangling = search.search(star, positions_, trace_.vertex, recorder).untangling;
    trace_.value_phrase = (trace_.untangling ? "smallest normalised Jacobian, once positive the " : "") + both_phrase(*aims_);
    const auto place = [&](Vec2<double> offset) { return displaced(mesh_.frame, trace_.from, offset, input_.mesh.single_precision); };
    take(std::move(recorder), place);
    const Vec3 target = place(trace_.found);
    end(target, search.gains(positions_, trace_.vertex, target));
  }

  [[nodiscard]] bool gains(Vec3 target) const { return gains_at<M>(mesh_, positions_, trace_.vertex, target); }

  /// place(offset): where the vertex would be stored.
  template <class Place>
  void take(Recorder recorder, const Place& place) {
    trace_.value_here = recorder.here;
    trace_.levels = std::move(recorder.levels);
    for (TracedLevel& level : trace_.levels) {
      level.quality.reserve(level.offsets.size());
      for (const Vec2<double>& offset : level.offsets)
        level.quality.push_back(quality_of(star_state<M>(mesh_, positions_, trace_.vertex, place(offset))));
      if (level.best) trace_.found = level.at(*level.best);
    }
  }

  void end(Vec3 target, bool moves) {
    if (trace_.found.x == 0.0 && trace_.found.y == 0.0)
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
        visit_planar(mesh_.frame, mesh_.corners_of(incidence.element), at, [&](const auto& shape) {
          quality = evaluate<M>(shape);
          inverted = formulas::smallest_jacobian(shape) <= 0.0;
        });
      };
      judge(trace_.from, change.before, change.inverted_before);
      judge(trace_.to, change.after, change.inverted_after);
      trace_.elements.push_back(change);
    }
  }

  const InputMesh& input_;
  PlanarView mesh_;
  PositionView positions_;
  const SearchParameters& parameters_;
  const std::optional<Aims>& aims_;
  VisitTrace trace_;
};

}  // namespace

std::string VisitTrace::sentence() const {
  switch (end) {
    case VisitEnd::Moved:
      if (combined && !untangling)
        return fmt::format("moved for two aims: worst element of its star {:.4g} -> {:.4g}", before.quality, after.quality);
      if (before.jacobian > 0.0) return fmt::format("moved: worst element of its star {:.4g} -> {:.4g}", before.quality, after.quality);
      if (after.jacobian > 0.0) return fmt::format("moved: untangled its star, whose worst element is {:.4g} now", after.quality);
      return fmt::format("moved: smallest Jacobian of its tangled star {:.4g} -> {:.4g}", before.jacobian, after.jacobian);
    case VisitEnd::NothingFound:
      if (combined) return "stays: no candidate is better for its two aims than where it stands";
      return "stays: no candidate is better than where it stands";
    case VisitEnd::NotConfirmed:
      return "stays: the best candidate gains nothing when judged exactly";
    case VisitEnd::Fixed:
      break;
  }
  return "fixed: it is not searched";
}

VisitTrace trace_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed, Metric metric,
                       const SearchParameters& parameters, Index vertex, const std::optional<Aims>& aims) {
  require_vertex(input, vertex);
  validate(parameters);
  if (!defined_around(input, metric, vertex))
    throw UsageError(fmt::format("{} is not defined for all elements around vertex {}", info(metric).name, vertex));
  const bool is_fixed = fixed[vertex] != 0 || input.topology.star(vertex).empty();
  return formulas::with_planar_metric(metric, [&]<Metric M>() { return Look<M>(input, positions, parameters, vertex, aims).run(is_fixed); });
}

}  // namespace dmoscope
