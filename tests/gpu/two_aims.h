#pragma once
// Two aims on a device compared with the processor: combined metrics, sizes, and the phase that raises the mean.

#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "core/smooth/size_field.h"
#include "tests/gpu/same_bits.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::testing {

/// The least metric of elements that can move, if it is positive: the floor of a phase that raises the mean.
[[nodiscard]] inline double floor_of(const Subject& subject, Metric metric) {
  const Statistics now =
      compute_statistics(subject.input->quality_context(), subject.input->mesh.positions, metric, subject.immovable, nullptr);
  return std::max(now.movable_minimum, 0.1);
}

/// Raises the mean after an iteration of its own, with one floor and another, and then does another iteration of the metric alone.
inline void expect_same_mean(const std::shared_ptr<Queue>& queue, const Subject& subject, Metric metric, const SearchParameters& search) {
  SCOPED_TRACE("mean");
  SmoothingTask task = subject.task(metric, search);
  task.then_mean = true;
  const double floor = floor_of(subject, metric);
  const std::vector<Sweep> sweeps{{}, {.floor = floor}, {.floor = floor}, {.floor = 0.5 * floor}, {}};
  expect_same_sweeps(queue, subject, task, sweeps);
}

/// `every`: uses one in so many of the second metrics.
inline void expect_same_combinations(const std::shared_ptr<Queue>& queue, const Subject& subject, Metric metric,
                                     const SearchParameters& search, std::size_t every = 1, std::size_t turn = 0) {
  using dmoscope::testing::defined_for_all;
  SmoothingTask task = subject.task(metric, search);
  const std::vector<Sweep> sweeps{{}, {}, {.untangling = {.attempt = false}}};
  for (const MetricInfo& second : metric_table()) {
    if (second.metric == metric || !defined_for_all(second.metric, subject.input->mesh) || turn++ % every != 0) continue;
    if (!subject.input->is_volume() && second.metric == Metric::Condition) continue;  // equals the mean ratio
    SCOPED_TRACE(second.name);
    task.combination = {0.3, second.metric};
    expect_same_sweeps(queue, subject, task, sweeps);
  }
  if (subject.input->is_volume()) return;
  using Kind = SizeFunction::Kind;
  for (const Kind kind : {Kind::Constant, Kind::Distance, Kind::InverseDistance}) {
    if (turn++ % every != 0) continue;
    SCOPED_TRACE(fmt::format("density {}", static_cast<int>(kind)));
    const SizeFunction size{kind, subject.input->mesh.positions[0] + Vec3{0.2, 0.1, 0.0}, {}};
    task.combination = {0.3, size};
    task.aim = std::make_shared<const SizeField>(subject.input, size);
    expect_same_sweeps(queue, subject, task, sweeps);
  }
}

}  // namespace dmoscope::gpu::testing
