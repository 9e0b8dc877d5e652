#pragma once
// The search for two aims at once (see composite_objective.h): the very grid search, with an objective that goes on beyond a threshold.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "core/search/surface_star.h"
#include "core/smooth/defined_state.h"
#include "core/smooth/kernels/composite_kernel.h"
#include "core/smooth/methods/two_aims_comparison.h"
#include "core/smooth/size_field.h"
#include "core/smooth/two_aims.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

/// The second aim of the phase that raises the mean: the mean quality of the star, by the first metric.
struct MeanOfStar {};

/// What a visit with two aims maximises. Which of two places is better for a vertex is decided in this order. While an element of the star
/// is inverted: where it is less so (see UntanglingObjective). While the star's least first metric is not beyond the threshold: where that
/// is greater. Then: where the second aim is greater. Beyond means above the threshold; for the mean, not below it, so that a star whose
/// least is the floor stays unless its mean rises.
struct CompositeObjective {
  Metric first = Metric::MeanRatio;
  double threshold = 0.7;  // at least 0
  std::variant<Metric, std::shared_ptr<const SizeField>, MeanOfStar> second = MeanOfStar{};

  [[nodiscard]] bool raise_mean() const noexcept { return std::holds_alternative<MeanOfStar>(second); }
  [[nodiscard]] bool beyond(double least) const noexcept { return is_beyond(least, threshold, raise_mean()); }
};

/// What a combination aims at; `size`: its size function, null where the second aim is a metric.
[[nodiscard]] CompositeObjective composite_objective(Metric first, const Combination& combination, std::shared_ptr<const SizeField> size);
/// The same as plain data; none where its sizes are those of a nodal field.
[[nodiscard]] std::optional<Aims> plain_aims(const CompositeObjective& composite);
/// What a phase that raises the mean aims at.
[[nodiscard]] CompositeObjective raise_mean_above(Metric metric, double floor);

/// The two aims that a visit of dmo has; none: one metric alone.
[[nodiscard]] std::optional<CompositeObjective> composite_objective_of_visit(Metric metric, const std::optional<Combination>& combination,
                                                                             const std::shared_ptr<const SizeField>& size,
                                                                             const Sweep& sweep);

/// The star of a vertex in double: Frame is Plane, Space or Curved.
template <class Frame>
struct JudgedStarOf {
  using Star = StarIn<Frame, double>;
  using View = StarViewIn<Frame, double>;
};
template <>
struct JudgedStarOf<Curved> {
  using Star = SurfaceStar;
  using View = SurfaceStarView;
};
template <class Frame>
using JudgedStar = typename JudgedStarOf<Frame>::Star;
template <class Frame>
using JudgedStarView = typename JudgedStarOf<Frame>::View;

/// What is needed of a metric, so that any two can be combined without a template for each pair.
template <class Frame>
struct MetricFunctions {
  using View = JudgedStarView<Frame>;
  using Offset = OffsetIn<Frame, double>;
  // By the statistics' formulas, with the vertex at a place.
  StarState (*state)(const MeshView<Frame>&, PositionView, Index vertex, Vec3 place);
  double (*mean)(const MeshView<Frame>&, PositionView, Index vertex, Vec3 place);
  // By the search's, with the vertex at an offset.
  double (*least_at)(const View&, Offset, double enough);  // what is no more than `enough` may be greater than it is
  double (*least_rank_at)(const View&, Offset);            // a rising function of the least
  double (*mean_at)(const View&, Offset, double enough);
  bool (*is_tangled)(const View&);
  double (*untangling_at)(const View&, const Untangling&, Offset);
};
/// Of a built-in metric.
template <class Frame>
[[nodiscard]] const MetricFunctions<Frame>& metric_functions(Metric metric);

/// Are all of its metrics built in, so that kernels know them?
[[nodiscard]] bool is_for_kernels(const CompositeObjective& composite);

/// The mean of the edge neighbours, weighted by the inverse of the size where each stands now.
[[nodiscard]] DensityTarget<Plane> density_target(const SizeField& size, const PlanarView& mesh, PositionView positions, Index vertex);

/// A star by metrics that are defined by formulas or targets; none where the metric is built in.
template <class Frame>
struct DefinedStars {
  std::shared_ptr<const DefinedStar<Frame>> first, second;
};

/// What the grid search maximises, as the paper's eq. (8) has it: the least first metric (or, untangling, what is raised while an element
/// is inverted, which is <= 0); beyond the threshold that plus the second aim, which is positive.
template <class Frame>
class CompositeScore {
 public:
  using View = JudgedStarView<Frame>;
  using Offset = OffsetIn<Frame, double>;
  /// `untangling`: of a star with inverted elements; else none.
  CompositeScore(const CompositeObjective& composite, const std::optional<Untangling>& untangling, View star,
                 const DensityTarget<Frame>& target, DefinedStars<Frame> defined = {})
      : composite_(composite), star_(star), target_(target), untangling_(untangling), defined_(std::move(defined)) {
    greatest_below_ = composite.raise_mean() ? std::nextafter(composite.threshold, -1.0) : composite.threshold;
    if (!defined_.first) first_ = &metric_functions<Frame>(composite.first);
    if (const auto* metric = std::get_if<Metric>(&composite.second); metric != nullptr && !defined_.second)
      second_ = metric_functions<Frame>(*metric).least_at;
    else if (composite.raise_mean() && !defined_.first)
      second_ = first_->mean_at;
  }
  /// `best`: what is worth no more may come out greater than it is, but never above this: nobody goes there.
  [[nodiscard]] double operator()(Offset p, double best = kAll) const {
    const double least = this->least(p, std::min(best, greatest_below_));
    return composite_.beyond(least) ? composite_.threshold + second(p) : least;
  }

 private:
  static constexpr double kAll = -std::numeric_limits<double>::infinity();

  [[nodiscard]] double least(Offset p, double enough) const {
    if (!defined_.first) return untangling_ ? first_->untangling_at(star_, *untangling_, p) : first_->least_at(star_, p, enough);
    if (!untangling_) return defined_.first->least(p);
    return UntanglingObjective<kDefinedMetric, typename DefinedStar<Frame>::View, Offset>(defined_.first->view(), *untangling_)(p);
  }
  [[nodiscard]] double second(Offset p) const {
    if (second_ != nullptr) return second_(star_, p, kAll);
    if (defined_.second) return positive(defined_.second->least(p));
    return composite_.raise_mean() ? positive(defined_.first->mean(p)) : target_.density(p);
  }
  /// A rising function that is above 0: formulas may be below.
  static double positive(double value) { return value > 0.0 ? 1.0 + value : 1.0 / (1.0 - value); }

  const CompositeObjective& composite_;
  View star_;
  DensityTarget<Frame> target_;  // in units of the star's scale
  std::optional<Untangling> untangling_;
  DefinedStars<Frame> defined_;
  const MetricFunctions<Frame>* first_ = nullptr;                   // of a built-in metric
  double greatest_below_;                                           // the greatest number not beyond the threshold
  double (*second_)(const View&, Offset, double enough) = nullptr;  // likewise, or the mean by one; null: the density, or a defined metric
};

/// What a kernel needs to know of the aims, but for densities.
template <class Frame>
[[nodiscard]] CompositeSearch<Frame> search_for(const CompositeObjective& composite, const SearchParameters& parameters) {
  CompositeSearch<Frame> task;
  task.points = parameters.grid_points;
  task.levels = parameters.levels;
  task.omega = parameters.omega;
  task.threshold = composite.threshold;
  task.inclusive = composite.raise_mean();
  if (const auto* metric = std::get_if<Metric>(&composite.second)) {
    task.second = CompositeSearch<Frame>::Second::Metric;
    task.metric = *metric;
  }
  return task;
}

/// Judges a star by two aims. The mesh must outlive it.
template <class Frame>
class StarJudge {
 public:
  using Star = JudgedStar<Frame>;
  StarJudge(const InputMesh& input, CompositeObjective composite);
  void begin(const Sweep& sweep) { untangling_ = sweep.untangling; }
  [[nodiscard]] const Untangling& untangling() const noexcept { return untangling_; }

  /// The star of a vertex, whether an element of it is inverted, and what a search maximises in it.
  void gather(PositionView positions, Index vertex, Star& star) const;
  [[nodiscard]] bool is_tangled(const Star& star) const {
    const Metric metric = is_built_in(composite_.first) ? composite_.first : Metric::MeanRatio;  // which sees it
    return metric_functions<Frame>(metric).is_tangled(JudgedStarView<Frame>(star));
  }
  [[nodiscard]] CompositeScore<Frame> score_of(const Star& star, PositionView positions, Index vertex, bool tangled) const;
  /// How good its star is by a metric, the first or second one, with a vertex at a place; by the statistics' formulas.
  [[nodiscard]] StarState state(Metric metric, PositionView positions, Index vertex, Vec3 place) const;
  /// By the statistics' own formulas: does the vertex gain by standing at `target`?
  [[nodiscard]] Confirmation confirm(PositionView positions, Index vertex, Vec3 target) const;

  [[nodiscard]] const CompositeObjective& composite() const noexcept { return composite_; }

 protected:
  [[nodiscard]] DensityTarget<Frame> density_of(const Star& star, PositionView positions, Index vertex) const;

 private:
  [[nodiscard]] double second(PositionView positions, Index vertex, Vec3 place) const;

  [[nodiscard]] double mean(PositionView positions, Index vertex, Vec3 place) const;
  [[nodiscard]] DefinedStarJudge<Frame> star_judge(const DefinedJudge& judge) const;

  const InputMesh* input_;
  MeshView<Frame> view_;
  CompositeObjective composite_;
  Untangling untangling_{};
  std::shared_ptr<const DefinedJudge> first_, second_;  // of metrics that are not built in
};

/// One vertex's visit: a rule for RuleSmoother. The mesh must outlive it.
template <class Frame>
class CompositeRule : public StarJudge<Frame> {
 public:
  using Star = StarIn<Frame, double>;
  using Offset = OffsetIn<Frame, double>;
  struct Scratch {
    Star star;
    StarPoints<Frame> points;
  };
  static constexpr std::size_t kGrain = std::is_same_v<Frame, Plane> ? 32 : 1;  // in space a visit may take half a millisecond
  CompositeRule(const InputMesh& input, CompositeObjective composite, const SearchParameters& parameters);
  /// For many visits.
  CompositeRule(const SmoothingTask& task, CompositeObjective composite);
  [[nodiscard]] std::span<const Index> others(Index vertex) const {
    return stars_ ? stars_->of(vertex).vertices : std::span<const Index>();
  }

  /// What was found: the offset in units of the star's scale, and whether an element was inverted.
  struct Found {
    Offset offset;
    bool untangling = false;
  };
  /// By packs of candidates where that can be, else, and where the precision asked for is double, the plain search; both compute in double
  /// and find the same.
  [[nodiscard]] Found search(const Star& star, PositionView positions, Index vertex) const;
  /// `trace`: see grid_search.
  template <class Trace = NoTrace>
  [[nodiscard]] Found search_plainly(const Star& star, PositionView positions, Index vertex, Trace&& trace = {}) const {
    const StarViewIn<Frame, double> view(star);
    const bool untangling = this->is_tangled(star);
    if (this->untangling().repair && !untangling) return {};
    const CompositeScore<Frame> objective = this->score_of(star, positions, vertex, untangling);
    const Offset middle = untangling ? middle_of<Offset>(view) : Offset{};
    return {grid_search<double>(objective, star.box, parameters_, trace, Solo{}, untangling ? &middle : nullptr).offset, untangling};
  }
  /// Where the vertex goes, if it gains there.
  [[nodiscard]] std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const;

 private:
  [[nodiscard]] std::optional<CompositeFound<Frame>> search_indexed(PositionView positions, Index vertex, Scratch& scratch) const;
  [[nodiscard]] std::optional<bool> gains_for_certain(Index vertex, const Scratch& scratch, Vec3 from, Vec3 target) const;
  [[nodiscard]] bool keeps_valid(PositionView positions, Index vertex, const Scratch& scratch, Vec3 target) const;
  [[nodiscard]] CompositeSearch<Frame> task_of(const Star& star, PositionView positions, Index vertex) const;

  RuleMesh<Frame> mesh_;
  bool has_inside_;  // any element: see there
  SearchParameters parameters_;
  CompositeKernel<Frame> kernel_;                // null: the plain search alone
  std::shared_ptr<const IndexedStars> stars_;    // where there is a kernel; shared: the rule is moved about
  std::optional<TwoAimsComparison> comparison_;  // likewise, in space
};

/// For any aims.
[[nodiscard]] std::unique_ptr<Smoother> make_composite_smoother(const SmoothingTask& task, CompositeObjective composite);
/// See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_composite_smoother(const SmoothingTask& task);

}  // namespace dmoscope
