#pragma once
// Objective on the star of one vertex: all that the methods see of metrics, formulas, targets and two aims (composite_objective.h).

#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/reference/domain.h"
#include "core/search/surface_star.h"
#include "core/smooth/composite_visit.h"
#include "core/smooth/defined_state.h"
#include "core/smooth/kernels/composite_kernel.h"
#include "core/smooth/place_aim.h"
#include "core/smooth/smoother.h"
#include "core/smooth/visit/star_pieces.h"

namespace dmoscope {

/// Second aim of the phase that raises the mean: the mean quality of the star, by the first metric.
struct MeanOfStar {
  MeanKind kind = MeanKind::Harmonic;
};

/// Objective of a visit. Which of two places is better for a vertex is decided in this order. While an element of the star is inverted:
/// where it is less so (see UntanglingObjective). While the star's least first metric is not beyond the threshold: where that is greater.
/// Then: where the second aim is greater. Beyond means above the threshold; for the mean, not below it, so that a star whose least is the
/// floor stays unless its mean rises. Nothing is beyond an infinite threshold: the first metric is the only aim.
struct CompositeObjective {
  Metric first = Metric::MeanRatio;
  double threshold = 0.7;  // at least 0
  std::variant<Metric, std::shared_ptr<const PlaceAim>, MeanOfStar> second = MeanOfStar{};
  std::optional<Guard> guard{};  // for stars without inverted elements

  [[nodiscard]] bool raise_mean() const noexcept { return std::holds_alternative<MeanOfStar>(second); }
  [[nodiscard]] bool beyond(double least) const noexcept { return is_beyond(least, threshold, raise_mean()); }
  [[nodiscard]] bool is_single() const noexcept { return threshold == std::numeric_limits<double>::infinity(); }
};

/// Objective with a metric as the only aim.
[[nodiscard]] CompositeObjective single_objective(Metric metric);
/// Objective of a combination; `aim`: its second aim, null where that is a metric.
[[nodiscard]] CompositeObjective composite_objective(Metric first, const CompositeTerms& combination, std::shared_ptr<const PlaceAim> aim);
/// Objective of a phase that raises a mean of `metric` and keeps its least from falling below `floor`.
[[nodiscard]] CompositeObjective raise_mean_above(Metric metric, double floor, MeanKind kind = MeanKind::Harmonic);
/// Objective of a sweep in that phase: with the sweep's floors, of which a combination has two.
[[nodiscard]] CompositeObjective raise_mean_in(const Sweep& sweep, Metric metric, const std::optional<CompositeTerms>& combination,
                                               const std::optional<Guard>& guard);
/// Objective of the task's own visits, which come before that phase.
[[nodiscard]] CompositeObjective objective_of(const SmoothingTask& task);
/// Objective as plain data; none where its sizes are those of a nodal field.
[[nodiscard]] std::optional<PlainComposite> plain_composite(const CompositeObjective& composite);

/// Two aims that a visit has; none: one metric alone, maybe with a guard.
[[nodiscard]] std::optional<CompositeObjective> composite_objective_of_visit(Metric metric,
                                                                             const std::optional<CompositeTerms>& combination,
                                                                             const std::shared_ptr<const PlaceAim>& aim, const Sweep& sweep,
                                                                             const std::optional<Guard>& guard = {});

/// Star of a vertex in double: Frame is Plane, Space or Curved.
template <class Frame>
using JudgedStar = std::conditional_t<std::is_same_v<Frame, Curved>, SurfaceStar,
                                      std::conditional_t<std::is_same_v<Frame, Plane>, Star<double>, VolumeStar<double>>>;
template <class Frame>
using JudgedStarView = std::conditional_t<std::is_same_v<Frame, Curved>, SurfaceStarView,
                                          std::conditional_t<std::is_same_v<Frame, Plane>, StarView<double>, VolumeStarView<double>>>;

/// Table of the functions of one metric, so that any two can be combined without a template for each pair.
template <class Frame>
struct MetricFunctions {
  using View = JudgedStarView<Frame>;
  using Offset = OffsetIn<Frame, double>;
  // Judges by the statistics' formulas, with the vertex at a place.
  StarState (*state)(const MeshView<Frame>&, PositionView, Index vertex, Vec3 place);
  double (*mean)(const MeshView<Frame>&, PositionView, Index vertex, Vec3 place, MeanKind kind);
  // Judges by the search's formulas, with the vertex at an offset.
  double (*least_at)(const View&, Offset, double enough);  // values of at most `enough` may come out greater than they are
  double (*least_rank_at)(const View&, Offset);            // a rising function of the least
  double (*mean_at)(const View&, Offset, MeanKind kind);
  bool (*is_tangled)(const View&, const Untangling&);
  // Judge each of a list of offsets: least_at(), and the number that is raised while an element is inverted.
  void (*least)(const View&, const CandidateList&, double enough, double* out);
  void (*untangling)(const View&, const Untangling&, const CandidateList&, double* out);
  void (*pieces)(const JudgedStar<Frame>&, Offset, std::vector<StarPiece<Frame>>& out);  // appends the metric's pieces: see StarPiece
};
/// Row of a built-in metric.
template <class Frame>
[[nodiscard]] const MetricFunctions<Frame>& metric_functions(Metric metric);

/// Returns whether all of its metrics are built in, so that kernels know them.
[[nodiscard]] bool is_for_kernels(const CompositeObjective& composite);

/// Stars by metrics that are defined by formulas or targets; none where the metric is built in.
template <class Frame>
struct DefinedStars {
  std::shared_ptr<const DefinedStar<Frame>> first, second, guard;
};

/// Describes the aims to a kernel, without densities.
template <class Frame>
[[nodiscard]] CompositeSearch<Frame> search_for(const CompositeObjective& composite, const SearchParameters& parameters) {
  CompositeSearch<Frame> task;
  task.points = parameters.grid_points;
  task.levels = parameters.levels;
  task.omega = parameters.omega;
  task.threshold = composite.threshold;
  task.inclusive = composite.raise_mean();
  if (const auto* mean = std::get_if<MeanOfStar>(&composite.second)) task.mean = mean->kind;
  if (const auto* metric = std::get_if<Metric>(&composite.second)) {
    task.second = CompositeSearch<Frame>::Second::Metric;
    task.metric = *metric;
  }
  return task;
}
/// Adds a star to a kernel's task, and the place from which its density is measured.
template <class Frame>
void take_star(CompositeSearch<Frame>& task, const CompositeObjective& composite, const JudgedStar<Frame>& star,
               const DensityTarget<Frame>& target) {
  task.star = lists_of(star);
  if (!std::holds_alternative<std::shared_ptr<const PlaceAim>>(composite.second)) return;
  task.second = CompositeSearch<Frame>::Second::Density;
  task.wanted = target.offset;
  task.edge = target.edge;
}

/// Score, the number that a search maximises, as the paper's eq. (8) has it: the least first metric (or, untangling, the number raised
/// while an element is inverted, which is <= 0); beyond the threshold that plus the second aim, which is positive. The star must outlive
/// it.
template <class Frame>
class StarScore {
 public:
  using View = JudgedStarView<Frame>;
  using Offset = OffsetIn<Frame, double>;
  /// `untangling`: the rule for a star with inverted elements; else none. `list_kernel`: null: the plain search alone. `guarded`: whether
  /// places to which the guard does not let the vertex go score below all.
  StarScore(const CompositeObjective& composite, const std::optional<Untangling>& untangling, const JudgedStar<Frame>& star,
            const DensityTarget<Frame>& target, DefinedStars<Frame> defined = {}, CompositeListKernel<Frame> list_kernel = nullptr,
            bool guarded = false);

  [[nodiscard]] bool tangled() const noexcept { return untangling_.has_value(); }
  /// Returns whether the score is above 0 wherever nothing is inverted: that of a formula need not be.
  [[nodiscard]] bool positive_where_sound() const noexcept { return !defined_.first; }
  /// Score of the star as if no element were inverted at the vertex's present place.
  [[nodiscard]] StarScore of_sound_star() const {
    StarScore other(*this);
    other.untangling_.reset();
    return other;
  }

  /// Score of a place. `best`: scores of at most this may come out greater than they are, but never above it: no vertex goes there.
  [[nodiscard]] double operator()(Offset p, double best = kAll) const {
    return guarded(p, with_second(p, this->least(p, std::min(best, greatest_below_))), best);
  }
  /// First of the candidates with the greatest score, if that is more than `best`, which it becomes; else their number.
  [[nodiscard]] std::size_t first_best(CandidateList& candidates, double& best) const;
  /// Appends the smooth functions of which the score is the least with the vertex at `p`, no element being inverted there: beyond the
  /// threshold those of the second aim, and those of the first less the amount by which the star is beyond. Not for the mean.
  void append_pieces(Offset p, std::vector<StarPiece<Frame>>& out) const;
  /// Appends the Jacobian of every corner that changes with the vertex, over its element's reference measure.
  void append_jacobians(Offset p, std::vector<StarPiece<Frame>>& out) const { dmoscope::append_jacobians<Frame>(*star_, p, out); }

  static constexpr double kAll = -std::numeric_limits<double>::infinity();

 private:
  [[nodiscard]] double least(Offset p, double enough) const;
  /// Score of a place whose least first metric is `least`.
  [[nodiscard]] double with_second(Offset p, double least) const {
    return composite_.beyond(least) ? composite_.threshold + second(p) : least;
  }
  [[nodiscard]] double second(Offset p) const;
  /// Score of a place: `value`, or below all where that is more than `best` and the guard does not let the vertex go there.
  [[nodiscard]] double guarded(Offset p, double value, double best) const {
    return value > best && guard_floor_ > kAll && least_of_guard(p) < guard_floor_ ? kAll : value;
  }
  [[nodiscard]] double least_of_guard(Offset p) const;
  void least(const CandidateList& candidates, double enough, std::vector<double>& out) const;
  void worth_beyond(const CandidateList& candidates, std::vector<double>& out) const;
  void append(Metric metric, const DefinedStar<Frame>* defined, Offset p, std::vector<StarPiece<Frame>>& out) const;
  void append_second(Offset p, std::vector<StarPiece<Frame>>& out) const;

  const CompositeObjective& composite_;
  const JudgedStar<Frame>* star_;
  DensityTarget<Frame> target_;  // target in units of the star's scale
  std::optional<Untangling> untangling_;
  DefinedStars<Frame> defined_;
  CompositeListKernel<Frame> list_kernel_;
  const MetricFunctions<Frame>* first_ = nullptr;  // for a built-in metric
  double greatest_below_;                          // the greatest number not beyond the threshold
  double guard_floor_ = kAll;
  double (*second_)(const View&, Offset, double enough) = nullptr;  // function of a built-in second metric; else null
};

/// Judge of stars by an objective. The mesh must outlive it.
template <class Frame>
class StarJudge {
 public:
  using Star = JudgedStar<Frame>;
  /// `packs`: instructions by which many candidates are judged at once, which finds the same; none: one by one. `pairs`: both stars of a
  /// vertex that has a follower in it are judged as one; null: none has.
  StarJudge(const InputMesh& input, CompositeObjective composite, std::optional<SimdLevel> packs = {},
            std::shared_ptr<const Domain> pairs = {});
  void begin(const Sweep& sweep) { untangling_ = sweep.untangling; }
  [[nodiscard]] const Untangling& untangling() const noexcept { return untangling_; }

  /// Gathers the star of a vertex; then whether an element of it is inverted, and the score that a search maximises in it.
  void gather(PositionView positions, Index vertex, Star& star) const;
  [[nodiscard]] bool is_tangled(const Star& star) const;
  /// `guarded`: see StarScore.
  [[nodiscard]] StarScore<Frame> score_of(const Star& star, PositionView positions, Index vertex, bool tangled, bool guarded = false) const;
  /// State of a vertex's star at a place by a metric, the first or second one; by the statistics' formulas.
  [[nodiscard]] StarState state(Metric metric, PositionView positions, Index vertex, Vec3 place) const;
  /// Returns, by the statistics' own formulas, whether the vertex gains by standing at `target`, whatever the guard says. `before`: its
  /// star by the first metric at its present place, where known.
  [[nodiscard]] Confirmation confirm(PositionView positions, Index vertex, Vec3 target, const StarState* before = nullptr) const;

  /// Returns whether the guard lets the vertex go there, where one is and no element of the star is inverted.
  [[nodiscard]] bool keeps_guard(PositionView positions, Index vertex, Vec3 target) const;

  [[nodiscard]] const CompositeObjective& composite() const noexcept { return composite_; }
  [[nodiscard]] const MeshView<Frame>& mesh() const noexcept { return view_; }
  /// Density target in units of the star's scale; all 0 where the second aim is none.
  [[nodiscard]] DensityTarget<Frame> density_of(const Star& star, PositionView positions, Index vertex) const;

 private:
  [[nodiscard]] double second(PositionView positions, Index vertex, Vec3 place) const;
  [[nodiscard]] double mean(PositionView positions, Index vertex, Vec3 place) const;
  [[nodiscard]] double own_mean(PositionView positions, Index vertex, Vec3 place) const;
  [[nodiscard]] StarState own_state(Metric metric, PositionView positions, Index vertex, Vec3 place) const;
  [[nodiscard]] Index follower(Index vertex) const { return pairs_ ? pairs_->follower(vertex) : kNoIndex; }
  [[nodiscard]] Confirmation soundness(PositionView positions, Index vertex, Vec3 target, bool tangled) const;
  [[nodiscard]] std::shared_ptr<const DefinedStar<Frame>> defined_star(const std::shared_ptr<const DefinedJudge>& judge,
                                                                       PositionView positions, Index vertex) const;
  [[nodiscard]] DefinedStarJudge<Frame> star_judge(const DefinedJudge& judge) const;

  const InputMesh* input_;
  MeshView<Frame> view_;
  CompositeObjective composite_;
  Untangling untangling_{};
  CompositeListKernel<Frame> list_kernel_ = nullptr;
  std::shared_ptr<const Domain> pairs_;  // null: no vertices move together

  std::shared_ptr<const DefinedJudge> first_, second_, guard_;  // for metrics that are not built in
};

/// State of a vertex's star by a metric, as the statistics judge it.
[[nodiscard]] StarState star_state(const InputMesh& input, PositionView positions, Metric metric, Index vertex);

}  // namespace dmoscope
