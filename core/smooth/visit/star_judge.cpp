#include "core/smooth/visit/star_judge.h"

#include <algorithm>
#include <array>

#include "core/search/joined_star.h"
#include "core/smooth/edge_neighbours.h"
#include "core/smooth/kernels/compiled/kernel_set.h"
#include "core/smooth/visit/defined_pieces.h"

namespace dmoscope {

namespace {

template <Metric M, class Frame>
double mean_of_star(const MeshView<Frame>& mesh, PositionView positions, Index vertex, Vec3 place, MeanKind kind) {
  return mean_at_place<M>(mesh, positions, vertex, place, kind);
}

// Flattened, because in a source with so many metrics the compiler leaves calls in the innermost loops, which take 2.5 times as long.
template <Metric M, class Frame>
[[gnu::flatten]] double least_at(const JudgedStarView<Frame>& star, OffsetIn<Frame, double> p, double enough) {
  using At = Worth<M, false, double, Value::Metric, OffsetIn<Frame, double>>;
  At worth;
  star.template for_each<At::kOthers>([&](const auto& element) {
    if (!(worth.value() <= enough)) worth.take(element, p);
  });
  return worth.value();
}

/// Least rank, which tells as well which of two places is better, and costs less; but the least metric where the rank is as rough as a
/// float (see rank_doubt()).
template <Metric M, class Frame>
double least_rank_at(const JudgedStarView<Frame>& star, OffsetIn<Frame, double> p) {
  using At = Worth<M, false, double, M == Metric::Rectangularity ? Value::Metric : Value::Rank, OffsetIn<Frame, double>>;
  At worth;
  star.template for_each<At::kOthers>([&](const auto& element) { worth.take(element, p); });
  return worth.value();
}

template <Metric M, class Frame>
double mean_at(const JudgedStarView<Frame>& star, OffsetIn<Frame, double> p, MeanKind kind) {
  return mean_of<M>(star, p, kind);
}

template <Metric M, class Frame>
using Untangled = UntanglingObjective<M, JudgedStarView<Frame>, OffsetIn<Frame, double>>;

template <Metric M, class Frame>
[[gnu::flatten]] bool is_tangled(const JudgedStarView<Frame>& star, const Untangling& rule) {
  return Untangled<M, Frame>(star, rule).tangled();
}

template <Metric M, class Frame>
void least(const JudgedStarView<Frame>& star, const CandidateList& candidates, double enough, double* out) {
  for (std::size_t i = 0; i < candidates.size(); ++i) out[i] = least_at<M, Frame>(star, candidates.get<OffsetIn<Frame, double>>(i), enough);
}

template <Metric M, class Frame>
void untangling(const JudgedStarView<Frame>& star, const Untangling& rule, const CandidateList& candidates, double* out) {
  const Untangled<M, Frame> objective(star, rule);
  for (std::size_t i = 0; i < candidates.size(); ++i) out[i] = objective(candidates.get<OffsetIn<Frame, double>>(i));
}

template <Metric M, class Frame>
MetricFunctions<Frame> functions_of() {
  return {star_state<M, Frame>,    mean_of_star<M, Frame>, least_at<M, Frame>,
          least_rank_at<M, Frame>, mean_at<M, Frame>,      is_tangled<M, Frame>,
          least<M, Frame>,         untangling<M, Frame>,   append_pieces<M, Frame, JudgedStar<Frame>>};
}

template <class Frame>
std::array<MetricFunctions<Frame>, kMetricCount> make_table() {
  std::array<MetricFunctions<Frame>, kMetricCount> table{};
  for (const MetricInfo& entry : metric_table()) {
    auto& functions = table[static_cast<std::size_t>(entry.metric)];
    if constexpr (std::is_same_v<Frame, Space>)
      functions = formulas::with_volume_metric(entry.metric, []<Metric M>() { return functions_of<M, Space>(); });
    else
      functions = formulas::with_planar_metric(entry.metric, []<Metric M>() { return functions_of<M, Frame>(); });
  }
  return table;
}

/// Rising function that is above 0: formulas may be below.
double positive(double value) { return value > 0.0 ? 1.0 + value : 1.0 / (1.0 - value); }

}  // namespace

template <class Frame>
const MetricFunctions<Frame>& metric_functions(Metric metric) {
  if (!is_built_in(metric)) refuse_defined_metric();
  static const auto table = make_table<Frame>();
  return table[static_cast<std::size_t>(metric)];
}
template const MetricFunctions<Plane>& metric_functions<Plane>(Metric);
template const MetricFunctions<Space>& metric_functions<Space>(Metric);
template const MetricFunctions<Curved>& metric_functions<Curved>(Metric);

CompositeObjective composite_objective(Metric first, const CompositeTerms& combination, std::shared_ptr<const PlaceAim> aim) {
  if (aim) return {first, combination.threshold, std::move(aim), {}};
  return {first, combination.threshold, std::get<Metric>(combination.second), {}};
}

CompositeObjective single_objective(Metric metric) { return {metric, std::numeric_limits<double>::infinity(), metric, {}}; }

CompositeObjective objective_of(const SmoothingTask& task) {
  CompositeObjective objective =
      task.combination ? composite_objective(task.metric, *task.combination, task.aim) : single_objective(task.metric);
  objective.guard = task.guard;
  return objective;
}

CompositeObjective raise_mean_above(Metric metric, double floor, MeanKind kind) {
  return {metric, floor > 0.0 ? floor : 0.0, MeanOfStar{kind}, {}};
}

CompositeObjective raise_mean_in(const Sweep& sweep, Metric metric, const std::optional<CompositeTerms>& combination,
                                 const std::optional<Guard>& guard) {
  CompositeObjective mean = raise_mean_above(metric, *sweep.floor, sweep.mean);
  mean.guard = guard;
  if (combination && sweep.second_floor) mean.guard = {std::get<Metric>(combination->second), *sweep.second_floor};
  return mean;
}

std::optional<CompositeObjective> composite_objective_of_visit(Metric metric, const std::optional<CompositeTerms>& combination,
                                                               const std::shared_ptr<const PlaceAim>& aim, const Sweep& sweep,
                                                               const std::optional<Guard>& guard) {
  if (sweep.floor) return raise_mean_in(sweep, metric, combination, guard);
  if (!combination) return std::nullopt;
  CompositeObjective objective = composite_objective(metric, *combination, aim);
  objective.guard = guard;
  return objective;
}

std::optional<PlainComposite> plain_composite(const CompositeObjective& composite) {
  PlainComposite aims{.threshold = composite.threshold};
  if (const auto* metric = std::get_if<Metric>(&composite.second)) {
    aims.second = PlainComposite::Second::Metric;
    aims.metric = *metric;
  } else if (const auto* aim = std::get_if<std::shared_ptr<const PlaceAim>>(&composite.second)) {
    const auto formula = (*aim)->formula();
    if (!formula) return std::nullopt;
    aims.second = PlainComposite::Second::Density;
    aims.size = *formula;
  } else {
    aims.mean = std::get<MeanOfStar>(composite.second).kind;
  }
  return aims;
}

bool is_for_kernels(const CompositeObjective& composite) {
  const auto* second = std::get_if<Metric>(&composite.second);
  return is_built_in(composite.first) && (second == nullptr || is_built_in(*second));
}

template <class Frame>
StarScore<Frame>::StarScore(const CompositeObjective& composite, const std::optional<Untangling>& untangling, const JudgedStar<Frame>& star,
                            const DensityTarget<Frame>& target, DefinedStars<Frame> defined, CompositeListKernel<Frame> list_kernel,
                            bool guarded)
    : composite_(composite),
      star_(&star),
      target_(target),
      untangling_(untangling),
      defined_(std::move(defined)),
      list_kernel_(guarded && defined_.guard ? nullptr : list_kernel) {
  greatest_below_ = composite.raise_mean() ? std::nextafter(composite.threshold, -1.0) : composite.threshold;
  if (!defined_.first) first_ = &metric_functions<Frame>(composite.first);
  if (const auto* metric = std::get_if<Metric>(&composite.second); metric != nullptr && is_built_in(*metric))
    second_ = metric_functions<Frame>(*metric).least_at;
  if (guarded && composite.guard && !untangling) guard_floor_ = std::min(composite.guard->floor, least_of_guard({}));
}

template <class Frame>
double StarScore<Frame>::least_of_guard(Offset p) const {
  return defined_.guard ? defined_.guard->least(p) : metric_functions<Frame>(composite_.guard->metric).least_at(*star_, p, kAll);
}

template <class Frame>
double StarScore<Frame>::least(Offset p, double enough) const {
  if (!untangling_) return defined_.first ? defined_.first->least(p) : first_->least_at(*star_, p, enough);
  if (defined_.first)
    return UntanglingObjective<kDefinedMetric, typename DefinedStar<Frame>::View, Offset>(defined_.first->view(), *untangling_)(p);
  double value = 0.0;
  thread_local CandidateList one;  // kept: a visit allocates nothing
  one.clear();
  one.add(p);
  first_->untangling(*star_, *untangling_, one, &value);
  return value;
}

template <class Frame>
double StarScore<Frame>::second(Offset p) const {
  if (second_ != nullptr) return second_(*star_, p, kAll);
  if (defined_.second) return positive(defined_.second->least(p));
  const auto* mean = std::get_if<MeanOfStar>(&composite_.second);
  if (mean == nullptr) return target_.density(p);
  return defined_.first ? positive(defined_.first->mean(p, mean->kind)) : first_->mean_at(*star_, p, mean->kind);
}

template <class Frame>
void StarScore<Frame>::least(const CandidateList& candidates, double enough, std::vector<double>& out) const {
  out.resize(candidates.size());
  if (!defined_.first) {
    if (untangling_) return first_->untangling(*star_, *untangling_, candidates, out.data());
    return first_->least(*star_, candidates, enough, out.data());
  }
  thread_local std::vector<Offset> offsets;  // kept: a visit allocates nothing
  offsets.clear();
  for (std::size_t i = 0; i < candidates.size(); ++i) offsets.push_back(candidates.get<Offset>(i));
  if (!untangling_) return defined_.first->least(offsets, enough, out.data());
  const UntanglingObjective<kDefinedMetric, typename DefinedStar<Frame>::View, Offset> objective(defined_.first->view(), *untangling_);
  typename DefinedStar<Frame>::Listed listed(*defined_.first, offsets);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    listed.take(i);
    out[i] = objective(offsets[i]);
  }
}

/// Scores of places beyond the threshold by the mean of a metric that is defined by a formula or a target; of other places, below all.
template <class Frame>
void StarScore<Frame>::worth_beyond(const CandidateList& candidates, std::vector<double>& out) const {
  thread_local std::vector<Offset> offsets;  // kept: a visit allocates nothing
  offsets.clear();
  for (std::size_t i = 0; i < candidates.size(); ++i) offsets.push_back(candidates.get<Offset>(i));
  out.resize(offsets.size());
  const double least = std::max(composite_.threshold, std::numeric_limits<double>::min());
  defined_.first->means(offsets, std::get<MeanOfStar>(composite_.second).kind, least, out.data());
  for (double& worth : out)
    if (worth > kAll) worth = composite_.threshold + positive(worth);
}

template <class Frame>
std::size_t StarScore<Frame>::first_best(CandidateList& candidates, double& best) const {
  if (list_kernel_ != nullptr && !untangling_) {
    CompositeSearch<Frame> task = search_for<Frame>(composite_, {});
    take_star(task, composite_, *star_, target_);
    if (guard_floor_ > kAll) task.guarded = composite_.guard->metric, task.guard_below = std::nextafter(guard_floor_, kAll);
    const CompositeBest found = list_kernel_(task, candidates.view(), best);
    if (found.ready) {
      best = found.worth;
      return found.index;
    }
  }
  thread_local std::vector<double> worth;  // kept: a visit allocates nothing
  const bool by_mean = composite_.raise_mean() && defined_.first && !untangling_ && best > composite_.threshold;
  if (by_mean)
    worth_beyond(candidates, worth);
  else
    least(candidates, std::min(best, greatest_below_), worth);
  std::size_t first = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto p = candidates.get<Offset>(i);
    worth[i] = guarded(p, by_mean ? worth[i] : with_second(p, worth[i]), best);
    if (worth[i] > best) best = worth[i], first = i;
  }
  return first;
}

template <class Frame>
void StarScore<Frame>::append_pieces(Offset p, std::vector<StarPiece<Frame>>& out) const {
  append(composite_.first, defined_.first.get(), p, out);
  double least = std::numeric_limits<double>::infinity();
  for (const StarPiece<Frame>& piece : out) least = std::min(least, piece.value);
  if (!composite_.beyond(least)) return;
  const std::size_t of_first = out.size();
  append_second(p, out);
  double second = std::numeric_limits<double>::infinity();
  for (std::size_t i = of_first; i < out.size(); ++i) second = std::min(second, out[i].value);
  for (std::size_t i = 0; i < of_first; ++i) out[i].value += second - composite_.threshold;
}

/// Appends the pieces of a metric; `defined`: its star where it is not built in.
template <class Frame>
void StarScore<Frame>::append(Metric metric, const DefinedStar<Frame>* defined, Offset p, std::vector<StarPiece<Frame>>& out) const {
  if (defined != nullptr) {
    append_defined_pieces(defined->judge(), defined->positions(), defined->vertex(), star_->scale, p, out);
    if (defined->follower() != kNoIndex)
      append_defined_pieces(defined->judge(), defined->positions(), defined->follower(), star_->scale, p, out);
    return;
  }
  metric_functions<Frame>(metric).pieces(*star_, p, out);
}

template <class Frame>
void StarScore<Frame>::append_second(Offset p, std::vector<StarPiece<Frame>>& out) const {
  if (const auto* metric = std::get_if<Metric>(&composite_.second)) return append(*metric, defined_.second.get(), p, out);
  if constexpr (std::is_same_v<Frame, Plane>) {  // sizes are for planar meshes: see require_possible()
    const Vec2<double> away = p - target_.offset;
    const double density = target_.density(p), square = target_.edge * target_.edge;
    out.push_back({density, square > 0.0 ? times(away, -2.0 * density * density / square) : Vec2<double>{}});
  }
}

template class StarScore<Plane>;
template class StarScore<Space>;
template class StarScore<Curved>;

template <class Frame>
DensityTarget<Frame> StarJudge<Frame>::density_of(const Star& star, PositionView positions, Index vertex) const {
  const auto* aim = std::get_if<std::shared_ptr<const PlaceAim>>(&composite_.second);
  if (aim == nullptr) return {};
  if constexpr (std::is_same_v<Frame, Plane>) {
    return (*aim)->target(view_, positions, vertex).in_units(star.scale);
  }
  return {};  // sizes are for planar meshes: see require_possible()
}

/// Second aim with the vertex at `place`.
template <class Frame>
double StarJudge<Frame>::second(PositionView positions, Index vertex, Vec3 place) const {
  if constexpr (std::is_same_v<Frame, Plane>) {
    if (const auto* aim = std::get_if<std::shared_ptr<const PlaceAim>>(&composite_.second))
      return (*aim)->target(view_, positions, vertex).density(view_.frame.offset(place, positions[vertex]));
  }
  if (const auto* metric = std::get_if<Metric>(&composite_.second)) return state(*metric, positions, vertex, place).quality;
  return mean(positions, vertex, place);
}

template <class Frame>
StarJudge<Frame>::StarJudge(const InputMesh& input, CompositeObjective composite, std::optional<SimdLevel> packs,
                            std::shared_ptr<const Domain> pairs)
    : input_(&input), view_(input.view<Frame>()), composite_(std::move(composite)), pairs_(std::move(pairs)) {
  if (pairs_ && pairs_->pairs().empty()) pairs_.reset();
  if (packs && is_for_kernels(composite_)) list_kernel_ = kernels(*packs).in<Frame>().composite_list(composite_.first);
  if (!is_built_in(composite_.first)) first_ = input.quality_context().judge(composite_.first);
  if (const auto* second = std::get_if<Metric>(&composite_.second); second != nullptr && !is_built_in(*second))
    second_ = input.quality_context().judge(*second);
  if (composite_.guard && !is_built_in(composite_.guard->metric)) guard_ = input.quality_context().judge(composite_.guard->metric);
}

template <class Frame>
DefinedStarJudge<Frame> StarJudge<Frame>::star_judge(const DefinedJudge& judge) const {
  return defined_star_judge<Frame>(*input_, judge);
}

template <class Frame>
StarState StarJudge<Frame>::state(Metric metric, PositionView positions, Index vertex, Vec3 place) const {
  const StarState own = own_state(metric, positions, vertex, place);
  const Index other = follower(vertex);
  if (other == kNoIndex) return own;
  const StarState beside = own_state(metric, positions, other, pairs_->place_of_follower(vertex, place));
  return {std::min(own.jacobian, beside.jacobian), std::min(own.quality, beside.quality), std::min(own.untangling, beside.untangling),
          own.inverted + beside.inverted, std::min(own.sound, beside.sound)};
}

template <class Frame>
StarState StarJudge<Frame>::own_state(Metric metric, PositionView positions, Index vertex, Vec3 place) const {
  if (is_built_in(metric)) return metric_functions<Frame>(metric).state(view_, positions, vertex, place);
  const auto& judge = metric == composite_.first ? first_ : composite_.guard && metric == composite_.guard->metric ? guard_ : second_;
  return defined_star_state(star_judge(*judge), positions, vertex, place);
}

template <class Frame>
double StarJudge<Frame>::mean(PositionView positions, Index vertex, Vec3 place) const {
  const double own = own_mean(positions, vertex, place);
  const Index other = follower(vertex);
  if (other == kNoIndex) return own;
  const MeanKind kind = std::get<MeanOfStar>(composite_.second).kind;
  const auto size = [this](Index v) { return static_cast<double>(view_.star(v).size()); };
  using Mean = PowerMean<double>;
  Mean both(kind);
  both.join(Mean::total_of(kind, own, size(vertex)));
  both.join(Mean::total_of(kind, own_mean(positions, other, pairs_->place_of_follower(vertex, place)), size(other)));
  return both.value(size(vertex) + size(other));
}

template <class Frame>
double StarJudge<Frame>::own_mean(PositionView positions, Index vertex, Vec3 place) const {
  const MeanKind kind = std::get<MeanOfStar>(composite_.second).kind;
  if (!first_) return metric_functions<Frame>(composite_.first).mean(view_, positions, vertex, place, kind);
  return defined_mean(star_judge(*first_), positions, vertex, place, kind);
}

template <class Frame>
bool StarJudge<Frame>::is_tangled(const Star& star) const {
  const Metric metric = is_built_in(composite_.first) ? composite_.first : Metric::MeanRatio;  // the metric that sees inversion
  return metric_functions<Frame>(metric).is_tangled(star, composite_.is_single() ? untangling_ : Untangling{});
}

template <class Frame>
StarScore<Frame> StarJudge<Frame>::score_of(const Star& star, PositionView positions, Index vertex, bool tangled, bool guarded) const {
  DefinedStars<Frame> defined;
  defined.first = defined_star(first_, positions, vertex);
  defined.second = defined_star(second_, positions, vertex);
  defined.guard = defined_star(guard_, positions, vertex);
  return {composite_,
          tangled ? std::optional(untangling_) : std::nullopt,
          star,
          density_of(star, positions, vertex),
          std::move(defined),
          list_kernel_,
          guarded};
}

template <class Frame>
std::shared_ptr<const DefinedStar<Frame>> StarJudge<Frame>::defined_star(const std::shared_ptr<const DefinedJudge>& judge,
                                                                         PositionView positions, Index vertex) const {
  if (!judge) return nullptr;
  return std::make_shared<const DefinedStar<Frame>>(star_judge(*judge), positions, vertex, follower(vertex));
}

template <class Frame>
bool StarJudge<Frame>::keeps_guard(PositionView positions, Index vertex, Vec3 target) const {
  if (!composite_.guard) return true;
  const auto at = [&](Vec3 place) { return state(composite_.guard->metric, positions, vertex, place); };
  const double there = at(target).quality;
  if (there >= composite_.guard->floor) return true;
  const StarState here = at(positions[vertex]);
  return !(here.jacobian > 0.0) || there >= here.quality;
}

template <class Frame>
Confirmation StarJudge<Frame>::confirm(PositionView positions, Index vertex, Vec3 target, const StarState* known) const {
  const Vec3 here = positions[vertex];
  const StarState before = known != nullptr ? *known : state(composite_.first, positions, vertex, here);
  const auto after = [&] { return state(composite_.first, positions, vertex, target); };
  if (composite_.is_single() && follower(vertex) == kNoIndex)
    return confirm_from(view_, positions, vertex, target, untangling_, before, after);
  if (composite_.is_single()) {
    if (!after().better_than(before, untangling_)) return Confirmation::GainsNothing;
    return soundness(positions, vertex, target, !(before.jacobian > 0.0));
  }
  const auto second_rises = [&] { return second(positions, vertex, target) > second(positions, vertex, here); };
  const auto sound = [&](bool tangled) { return soundness(positions, vertex, target, tangled); };
  return confirm_composite(composite_, before, after(), untangling_, sound, second_rises);
}

template <class Frame>
Confirmation StarJudge<Frame>::soundness(PositionView positions, Index vertex, Vec3 target, bool tangled) const {
  const Confirmation own = confirm_soundness(view_, positions, vertex, target, tangled);
  const Index other = follower(vertex);
  if (own != Confirmation::Gains || other == kNoIndex) return own;
  return confirm_soundness(view_, positions, other, pairs_->place_of_follower(vertex, target), tangled);
}

template <class Frame>
void StarJudge<Frame>::gather(PositionView positions, Index vertex, Star& star) const {
  gather_star_with(view_, positions, vertex, follower(vertex), star);
}

template class StarJudge<Plane>;
template class StarJudge<Space>;
template class StarJudge<Curved>;

StarState star_state(const InputMesh& input, PositionView positions, Metric metric, Index vertex) {
  const auto state = [&]<class Frame>() {
    return StarJudge<Frame>(input, single_objective(metric)).state(metric, positions, vertex, positions[vertex]);
  };
  if (input.is_surface()) return state.template operator()<Curved>();
  return input.is_volume() ? state.template operator()<Space>() : state.template operator()<Plane>();
}

}  // namespace dmoscope
