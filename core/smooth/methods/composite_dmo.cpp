#include "core/smooth/methods/composite_dmo.h"

#include <algorithm>
#include <array>

#include "core/smooth/edge_neighbours.h"
#include "core/smooth/methods/slide.h"

namespace dmoscope {

namespace {

template <Metric M, class Frame>
double mean_of_star(const MeshView<Frame>& mesh, PositionView positions, Index vertex, Vec3 place) {
  return mean_at_place<M>(mesh, positions, vertex, place);
}

template <Metric M, class Frame>
double least_at(const JudgedStarView<Frame>& star, OffsetIn<Frame, double> p, double enough) {
  using At = Worth<M, false, double, Value::Metric, OffsetIn<Frame, double>>;
  At worth;
  star.template for_each<At::kOthers>([&](const auto& element) {
    if (!(worth.value() <= enough)) worth.take(element, p);
  });
  return worth.value();
}

/// The least rank tells as well which of two places is better, and costs less; but where it is as rough as a float (see rank_doubt()).
template <Metric M, class Frame>
double least_rank_at(const JudgedStarView<Frame>& star, OffsetIn<Frame, double> p) {
  using At = Worth<M, false, double, M == Metric::Rectangularity ? Value::Metric : Value::Rank, OffsetIn<Frame, double>>;
  At worth;
  star.template for_each<At::kOthers>([&](const auto& element) { worth.take(element, p); });
  return worth.value();
}

template <Metric M, class Frame>
bool is_tangled(const JudgedStarView<Frame>& star) {
  return UntanglingObjective<M, JudgedStarView<Frame>, OffsetIn<Frame, double>>(star, {}).tangled();
}

template <Metric M, class Frame>
double untangling_at(const JudgedStarView<Frame>& star, const Untangling& rule, OffsetIn<Frame, double> p) {
  return UntanglingObjective<M, JudgedStarView<Frame>, OffsetIn<Frame, double>>(star, rule)(p);
}

template <Metric M, class Frame>
double mean_at(const JudgedStarView<Frame>& star, OffsetIn<Frame, double> p, double /*enough*/) {
  return mean_of<M>(star, p);
}

/// Does its sign tell whether a quadrilateral is inverted?
bool sees_inversion(Metric metric) {
  return formulas::with_planar_metric(metric, []<Metric M>() { return formulas::Formula<M>::kSeesInversion; });
}

template <Metric M, class Frame>
MetricFunctions<Frame> functions_of() {
  return {star_state<M, Frame>, mean_of_star<M, Frame>, least_at<M, Frame>,     least_rank_at<M, Frame>,
          mean_at<M, Frame>,    is_tangled<M, Frame>,   untangling_at<M, Frame>};
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

CompositeObjective composite_objective(Metric first, const Combination& combination, std::shared_ptr<const SizeField> size) {
  if (size) return {first, combination.threshold, std::move(size)};
  return {first, combination.threshold, std::get<Metric>(combination.second)};
}

CompositeObjective raise_mean_above(Metric metric, double floor) { return {metric, floor > 0.0 ? floor : 0.0, MeanOfStar{}}; }

std::optional<CompositeObjective> composite_objective_of_visit(Metric metric, const std::optional<Combination>& combination,
                                                               const std::shared_ptr<const SizeField>& size, const Sweep& sweep) {
  if (sweep.floor) return raise_mean_above(metric, *sweep.floor);
  if (combination) return composite_objective(metric, *combination, size);
  return std::nullopt;
}

std::optional<Aims> plain_aims(const CompositeObjective& composite) {
  Aims aims{.threshold = composite.threshold};
  if (const auto* metric = std::get_if<Metric>(&composite.second)) {
    aims.second = Aims::Second::Metric;
    aims.metric = *metric;
  } else if (const auto* size = std::get_if<std::shared_ptr<const SizeField>>(&composite.second)) {
    const auto formula = (*size)->formula();
    if (!formula) return std::nullopt;
    aims.second = Aims::Second::Density;
    aims.size = *formula;
  }
  return aims;
}

DensityTarget<Plane> density_target(const SizeField& size, const PlanarView& mesh, PositionView positions, Index vertex) {
  return density_target_by(mesh, positions, vertex, [&size](Index other, Vec3 place) { return size.at(other, place); });
}

bool is_for_kernels(const CompositeObjective& composite) {
  const auto* second = std::get_if<Metric>(&composite.second);
  return is_built_in(composite.first) && (second == nullptr || is_built_in(*second));
}

template <class Frame>
CompositeRule<Frame>::CompositeRule(const InputMesh& input, CompositeObjective composite, const SearchParameters& parameters)
    : StarJudge<Frame>(input, std::move(composite)),
      mesh_(input),
      has_inside_(input.is_volume() && std::ranges::any_of(input.mesh.elements.kinds(), &has_inside)),
      parameters_(parameters),
      kernel_(parameters.precision == Precision::Double || !is_for_kernels(this->composite())
                  ? nullptr
                  : composite_kernel<Frame>(parameters.simd.value_or(best_simd_level()), this->composite().first)) {}

template <class Frame>
CompositeRule<Frame>::CompositeRule(const SmoothingTask& task, CompositeObjective composite)
    : CompositeRule(*task.input, std::move(composite), task.search) {
  if (kernel_ == nullptr) return;
  stars_ = std::make_shared<const IndexedStars>(*task.input, *task.colouring, task.pool);
  if constexpr (std::is_same_v<Frame, Space>)
    comparison_.emplace(task.search.simd.value_or(best_simd_level()), this->composite().first, *plain_aims(this->composite()));
}

template <class Frame>
typename CompositeRule<Frame>::Found CompositeRule<Frame>::search(const Star& star, PositionView positions, Index vertex) const {
  if (kernel_ != nullptr && !this->untangling().repair && !this->is_tangled(star)) {
    const CompositeFound<Frame> found = kernel_(task_of(star, positions, vertex));
    if (found.ready) return {found.offset, false};
  }
  return search_plainly(star, positions, vertex);
}

template <class Frame>
CompositeSearch<Frame> CompositeRule<Frame>::task_of(const Star& star, PositionView positions, Index vertex) const {
  CompositeSearch<Frame> task = search_for<Frame>(this->composite(), parameters_);
  task.star = lists_of(star);
  task.box = star.box;
  if (std::holds_alternative<std::shared_ptr<const SizeField>>(this->composite().second)) {
    task.second = CompositeSearch<Frame>::Second::Density;
    const DensityTarget<Frame> target = this->density_of(star, positions, vertex);
    task.wanted = target.offset;
    task.edge = target.edge;
  }
  return task;
}

template <class Frame>
DensityTarget<Frame> StarJudge<Frame>::density_of(const Star& star, PositionView positions, Index vertex) const {
  const auto* size = std::get_if<std::shared_ptr<const SizeField>>(&composite_.second);
  if (size == nullptr) return {};
  if constexpr (std::is_same_v<Frame, Plane>) {
    return density_target(**size, view_, positions, vertex).in_units(star.scale);
  }
  return {};  // sizes are of planar meshes: see require_possible()
}

/// The second aim with the vertex at `place`.
template <class Frame>
double StarJudge<Frame>::second(PositionView positions, Index vertex, Vec3 place) const {
  if constexpr (std::is_same_v<Frame, Plane>) {
    if (const auto* size = std::get_if<std::shared_ptr<const SizeField>>(&composite_.second))
      return density_target(**size, view_, positions, vertex).density(view_.frame.offset(place, positions[vertex]));
  }
  if (const auto* metric = std::get_if<Metric>(&composite_.second)) return state(*metric, positions, vertex, place).quality;
  return mean(positions, vertex, place);
}

template <class Frame>
StarJudge<Frame>::StarJudge(const InputMesh& input, CompositeObjective composite)
    : input_(&input), view_(input.view<Frame>()), composite_(std::move(composite)) {
  if (!is_built_in(composite_.first)) first_ = input.quality_context().judge(composite_.first);
  if (const auto* second = std::get_if<Metric>(&composite_.second); second != nullptr && !is_built_in(*second))
    second_ = input.quality_context().judge(*second);
}

template <class Frame>
DefinedStarJudge<Frame> StarJudge<Frame>::star_judge(const DefinedJudge& judge) const {
  return defined_star_judge<Frame>(*input_, judge);
}

template <class Frame>
StarState StarJudge<Frame>::state(Metric metric, PositionView positions, Index vertex, Vec3 place) const {
  if (is_built_in(metric)) return metric_functions<Frame>(metric).state(view_, positions, vertex, place);
  return defined_star_state(star_judge(metric == composite_.first ? *first_ : *second_), positions, vertex, place);
}

template <class Frame>
double StarJudge<Frame>::mean(PositionView positions, Index vertex, Vec3 place) const {
  if (!first_) return metric_functions<Frame>(composite_.first).mean(view_, positions, vertex, place);
  return defined_mean(star_judge(*first_), positions, vertex, place);
}

template <class Frame>
CompositeScore<Frame> StarJudge<Frame>::score_of(const Star& star, PositionView positions, Index vertex, bool tangled) const {
  DefinedStars<Frame> defined;
  if (first_) defined.first = std::make_shared<const DefinedStar<Frame>>(star_judge(*first_), positions, vertex);
  if (second_) defined.second = std::make_shared<const DefinedStar<Frame>>(star_judge(*second_), positions, vertex);
  return {composite_, tangled ? std::optional(untangling_) : std::nullopt, star, density_of(star, positions, vertex), std::move(defined)};
}

template <class Frame>
Confirmation StarJudge<Frame>::confirm(PositionView positions, Index vertex, Vec3 target) const {
  const Vec3 here = positions[vertex];
  const StarState before = state(composite_.first, positions, vertex, here), after = state(composite_.first, positions, vertex, target);
  const auto second_rises = [&] { return second(positions, vertex, target) > second(positions, vertex, here); };
  const auto soundness = [&](bool tangled) { return confirm_soundness(view_, positions, vertex, target, tangled, untangling_); };
  return confirm_by_two(composite_, before, after, untangling_, soundness, second_rises);
}

template <class Frame>
void StarJudge<Frame>::gather(PositionView positions, Index vertex, Star& star) const {
  if constexpr (std::is_same_v<Frame, Curved>)
    gather_star(view_, positions, vertex, star);
  else
    gather_star(MeshStar(view_, positions, vertex), star);
}

template class StarJudge<Plane>;
template class StarJudge<Space>;
template class StarJudge<Curved>;

/// By the kernel, of a star by its indices; nothing where the star is not for it.
template <class Frame>
std::optional<CompositeFound<Frame>> CompositeRule<Frame>::search_indexed(PositionView positions, Index vertex, Scratch& scratch) const {
  if (!stars_ || this->untangling().repair) return std::nullopt;
  const IndexedStars::Star star = stars_->of(vertex);
  if (!star.fits) return std::nullopt;
  gather_points(mesh_.view.frame, star, positions, vertex, scratch.points);
  fill_star(star, scratch.points, scratch.star);
  const CompositeFound<Frame> found = kernel_(task_of(scratch.star, positions, vertex));
  return found.ready ? std::optional(found) : std::nullopt;
}

/// As gains(), by the star as it was searched; nothing where rounding may decide.
template <class Frame>
std::optional<bool> CompositeRule<Frame>::gains_for_certain(Index vertex, const Scratch& scratch, Vec3 from, Vec3 target) const {
  if constexpr (std::is_same_v<Frame, Space>) {
    return comparison_->gains(stars_->of(vertex).elements, scratch.points, from, target);
  } else {
    const CompositeObjective& composite = this->composite();
    const Metric* second = std::get_if<Metric>(&composite.second);
    // That no corner turns over is for the statistics' formulas to say where the metric does not; what densities are, too.
    if ((!scratch.star.quadrilaterals.empty() && !sees_inversion(composite.first)) || (second == nullptr && !composite.raise_mean()))
      return std::nullopt;
    const JudgedStarView<Frame> star(scratch.star);
    const Offset step = times(mesh_.view.frame.offset(target, from), 1.0 / scratch.star.scale);
    const MetricFunctions<Frame>& first = metric_functions<Frame>(composite.first);
    const BeforeAndAfter least{first.least_at(star, Offset{}, 0.0), first.least_at(star, step, 0.0)};
    return dmoscope::gains_for_certain(composite.threshold, least, [&]() -> BeforeAndAfter {
      if (second == nullptr) return {first.mean_at(star, Offset{}, 0.0), first.mean_at(star, step, 0.0)};
      const auto rank_at = metric_functions<Frame>(*second).least_rank_at;
      return {rank_at(star, Offset{}), rank_at(star, step)};
    });
  }
}

template <class Frame>
bool CompositeRule<Frame>::keeps_valid(PositionView positions, Index vertex, const Scratch& scratch, Vec3 target) const {
  if constexpr (std::is_same_v<Frame, Space>)
    if (comparison_->valid_at(stars_->of(vertex).elements, scratch.points, target)) return true;
  return keeps_sound(mesh_.view, positions, vertex, target);
}

template <class Frame>
std::optional<Vec3> CompositeRule<Frame>::target(PositionView positions, Index vertex, Scratch& scratch) const {
  const auto indexed = search_indexed(positions, vertex, scratch);
  if (!indexed) this->gather(positions, vertex, scratch.star);
  const Offset found = indexed ? indexed->offset : search(scratch.star, positions, vertex).offset;
  if (found == Offset{}) return std::nullopt;
  const Offset step = times(found, scratch.star.scale);
  const auto target = mesh_.moved(positions[vertex], step);
  if (!target) return std::nullopt;
  const auto known = indexed ? gains_for_certain(vertex, scratch, positions[vertex], *target) : std::nullopt;
  if (known && !*known) return std::nullopt;
  if (known && (!has_inside_ || keeps_valid(positions, vertex, scratch, *target))) return target;
  return mesh_.moved_if(positions[vertex], step, [&](Vec3 place) { return this->confirm(positions, vertex, place); });
}

template class CompositeRule<Plane>;
template class CompositeRule<Space>;

namespace {
template <class Frame>
std::unique_ptr<Smoother> make_composite_smoother_in(const SmoothingTask& task, const CompositeObjective& composite) {
  return make_sliding_smoother<Frame>(task, CompositeRule<Frame>(task, composite), composite);
}
}  // namespace

std::unique_ptr<Smoother> make_composite_smoother(const SmoothingTask& task, CompositeObjective composite) {
  if (task.input->is_surface()) return make_surface_smoother(task, std::move(composite));
  return task.input->is_volume() ? make_composite_smoother_in<Space>(task, composite) : make_composite_smoother_in<Plane>(task, composite);
}

std::unique_ptr<Smoother> make_composite_smoother(const SmoothingTask& task) {
  return make_composite_smoother(task, composite_objective(task.metric, *task.combination, task.size));
}

}  // namespace dmoscope
