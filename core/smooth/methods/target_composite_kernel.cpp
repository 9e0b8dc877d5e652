#include "core/smooth/methods/target_composite_kernel.h"

#include <algorithm>
#include <cmath>

#include "core/base/memory.h"
#include "core/base/thread_pool.h"
#include "core/mesh/plane.h"
#include "core/smooth/kernels/compiled/kernel_set.h"
#include "core/smooth/kernels/solid_target.h"
#include "core/smooth/kernels/targets/star_targets.h"
#include "core/smooth/kernels/targets/target_star.h"

namespace dmoscope {

namespace {

constexpr std::size_t kTargetStarsAtOnce = 1024;

/// Facts on the search of a planar star's targets.
PlanarStarTargets::Star facts_of_targets(std::span<const double> numbers, bool crossed) {
  PlanarStarTargets::Star star{numbers.data(), 0.0, 1.0, true};
  const std::size_t size = target_numbers(crossed);
  for (std::size_t first = 0; first < numbers.size(); first += size) {
    const auto t = crossed ? corner_target<true, double>([&](std::size_t k) { return numbers[first + k]; })
                           : corner_target<false, double>([&](std::size_t k) { return numbers[first + k]; });
    const double right = t.l11 * t.l11 + t.l21 * t.l21 + t.l22 * t.l22, left = t.k11 * t.k11 + t.k12 * t.k12 + t.k22 * t.k22;
    star.doubt = std::max(star.doubt, target_star::doubt(t));
    star.stretch = std::max(star.stretch, right * left);
    // Excludes metrics that fall more slowly than the mean ratio: they may be above 0 where an element is inverted.
    star.fits = star.fits && t.steepness >= 1.0 && std::abs(t.k12) < target_star::kMostOblique * t.k22;
  }
  star.fits = star.fits && star.doubt < 1e-6;
  return star;
}

}  // namespace

PlanarStarTargets::PlanarStarTargets(const TargetTable& targets, const InputMesh& input, const Colouring& colouring, ThreadPool* pool)
    : crossed_(has_crossed_targets(targets, static_cast<Index>(input.mesh.elements.size()))),
      chunks_((colouring.order.size() + kTargetStarsAtOnce - 1) / kTargetStarsAtOnce),
      stars_(input.mesh.positions.size()) {
  for_chunks(pool, colouring.order.size(), kTargetStarsAtOnce, [&](std::size_t first, std::size_t last) {
    std::vector<double> numbers;
    std::vector<std::size_t> ends;
    for (std::size_t visit = first; visit < last; ++visit) {
      append_star_targets(targets, crossed_, input.mesh, input.topology, colouring.order[visit], {.kind = StarShape::Kind::General}, {},
                          numbers);
      ends.push_back(numbers.size());
    }
    numbers.shrink_to_fit();
    for (std::size_t visit = first, from = 0; visit < last; from = ends[visit - first], ++visit)
      stars_[colouring.order[visit]] = facts_of_targets(std::span(numbers).subspan(from, ends[visit - first] - from), crossed_);
    chunks_[first / kTargetStarsAtOnce] = std::move(numbers);  // the numbers stay at their place in memory
  });
}

PlanarStarTargets::Star SolidStarTargets::of(Index vertex) const {
  constexpr double kDoubt = 1e-8;  // far more than rounding, for targets that fit
  const auto star = view_.star(vertex);
  if (!targets_.fit(star)) return {};
  thread_local std::vector<double> numbers;  // kept: a visit allocates nothing
  numbers.clear();
  const std::size_t size = volumes::solid_target_numbers(targets_.crossed());
  double stretch = 1.0;
  for (const Incidence& at : star) {
    const double* g = targets_.numbers() + size * at.element;
    const double of_corner[4][3] = {
        {-(g[0] + g[1] + g[3]), -(g[2] + g[4]), -g[5]}, {g[0], 0.0, 0.0}, {g[1], g[2], 0.0}, {g[3], g[4], g[5]}};
    for (Index k = 1; k < 4; ++k) {
      const double* row = of_corner[turned::tetrahedron(at.corner, k)];
      numbers.insert(numbers.end(), row, row + 3);
    }
    numbers.insert(numbers.end(), g + 6, g + size);
    double right = 0.0, left = 0.0;
    for (std::size_t k = 0; k < 6; ++k) right += g[k] * g[k];
    for (std::size_t k = 6; k < size; ++k) left += g[k] * g[k];
    stretch = std::max(stretch, right * std::max(left, 1.0));
  }
  return {numbers.data(), kDoubt, stretch, true};
}

template <class Frame>
bool TargetCompositeKernel<Frame>::is_for(const SmoothingTask& task, const CompositeObjective& objective) {
  if (!objective.raise_mean() || is_built_in(objective.first) || task.search.precision != Precision::Float) return false;
  const DefinedMetric& metric = defined(objective.first);
  if (metric.base != Metric::MeanRatio || metric.target.is_ideal() || task.search.grid_points > kMaxCompositePoints) return false;
  const Plane& plane = task.input->geometry.plane;
  return std::is_same_v<Frame, Space> || (PlaneAxes(plane).u >= 0 && !(plane.period > 0.0));
}

template <class Frame>
TargetCompositeKernel<Frame>::TargetCompositeKernel(const SmoothingTask& task, const CompositeObjective& objective)
    : mesh_(task.input->view<Frame>()),
      judge_(task.input->quality_context().judge(objective.first)),
      targets_([&] {
        if constexpr (std::is_same_v<Frame, Plane>)
          return PlanarStarTargets(judge_->targets(), *task.input, *task.colouring, task.pool);
        else
          return SolidStarTargets(judge_->targets(), *task.input);
      }()),
      kernel_(kernels(task.search).in<Frame>().target_mean(targets_.crossed())),
      stars_(*task.input, *task.colouring, task.pool) {
  aims_.points = task.search.grid_points;
  aims_.omega = task.search.omega;
  aims_.threshold = objective.threshold;
  aims_.mean = std::get<MeanOfStar>(objective.second).kind;
}

template <class Frame>
typename TargetCompositeKernel<Frame>::Room& TargetCompositeKernel<Frame>::room() {
  thread_local Room room;  // kept: a visit allocates nothing
  return room;
}

template <class Frame>
typename TargetCompositeKernel<Frame>::Found TargetCompositeKernel<Frame>::find(PositionView positions, Index vertex,
                                                                                const Untangling& /*untangling*/, int levels) const {
  const IndexedStars::Star star = stars_.of(vertex);
  if (!star.fits) return {};
  const PlanarStarTargets::Star targets = targets_.of(vertex);
  if (!targets.fits) return {};
  if (star.elements.counts[static_cast<std::size_t>(StarKind::Quadrilaterals)] > kMaxOthers) return {};
  Room& room = this->room();
  gather_points(mesh_.frame, star, positions, vertex, room.points);
  fill_star(star, room.points, room.star);
  TargetMeanSearch<Frame>& task = room.task = aims_;
  task.star = lists_of(room.star);
  task.targets = targets.numbers;
  task.doubt = targets.doubt;
  task.stretch = targets.stretch;
  task.here = mesh_.frame.project(positions[vertex]);
  task.scale = room.star.scale;
  task.box = room.star.box;
  task.levels = levels;
  const CompositeFound<Frame> found = kernel_.search(task);
  return {found.ready, found.offset, room.star.scale, room.star.box};
}

template <class Frame>
std::optional<bool> TargetCompositeKernel<Frame>::gains(PositionView positions, Index vertex, Vec3 target) const {
  const TargetMeanSearch<Frame>& task = room().task;
  const auto step = times(mesh_.frame.offset(target, positions[vertex]), 1.0 / task.scale);
  const TargetMeanWorth before = kernel_.worth(task, {}), after = kernel_.worth(task, step);
  if (!(before.least > task.threshold + task.doubt)) return std::nullopt;
  if (after.least < task.threshold - task.doubt) return false;
  if (!(after.least > task.threshold + task.doubt)) return std::nullopt;
  if (after.sum - after.doubt > before.sum + before.doubt) return true;
  return after.sum + after.doubt < before.sum - before.doubt ? std::optional(false) : std::nullopt;
}

template class TargetCompositeKernel<Plane>;
template class TargetCompositeKernel<Space>;

}  // namespace dmoscope
