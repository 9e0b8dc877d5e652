#pragma once
// The smoother on a device compared with the processor's: both make the same visits.

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/colouring.h"
#include "core/quality/quality.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/methods/dmo.h"
#include "gpu/device_dmo.h"

namespace dmoscope::gpu::testing {

/// An input mesh with what a run derives from it.
struct Subject {
  std::shared_ptr<const InputMesh> input;
  std::shared_ptr<const Colouring> colouring;
  std::vector<Index> immovable;

  explicit Subject(std::shared_ptr<const InputMesh> mesh) : input(std::move(mesh)) {
    const auto boundary = input->topology.boundary();
    std::vector<Index> free;
    for (Index v = 0; v < boundary.size(); ++v)
      if (boundary[v] == 0 && !input->topology.star(v).empty()) free.push_back(v);
    Colouring classes = colour_vertices(input->mesh, input->topology, free);
    arrange_classes(classes, input->mesh, input->is_volume() ? nullptr : &input->geometry.plane, input->topology);
    colouring = std::make_shared<const Colouring>(std::move(classes));
    immovable = immovable_elements(input->mesh, boundary, nullptr);
  }
  [[nodiscard]] SmoothingTask task(Metric metric, const SearchParameters& search = {}, ThreadPool* pool = nullptr) const {
    return {.input = input, .colouring = colouring, .metric = metric, .search = search, .immovable = immovable, .pool = pool};
  }
  [[nodiscard]] std::uint64_t visits() const { return colouring->order.size(); }
};

/// Values for suites whose tests hold for every metric that has a kernel for planar meshes; Condition is the mean ratio there.
[[nodiscard]] inline auto every_metric() {
  std::vector<Metric> all;
  for (const MetricInfo& entry : metric_table())
    if (entry.metric != Metric::Condition) all.push_back(entry.metric);
  return ::testing::ValuesIn(all);
}
/// Values for suites of volumes.
[[nodiscard]] inline auto every_volume_metric() {
  std::vector<Metric> all;
  for (const MetricInfo& entry : metric_table())
    if (entry.defined_for(ElementKind::Tetrahedron)) all.push_back(entry.metric);
  return ::testing::ValuesIn(all);
}
[[nodiscard]] inline std::string name_of_metric(const ::testing::TestParamInfo<Metric>& tested) {
  std::string name(dmoscope::info(tested.param).name);
  std::erase(name, '-');
  return name;
}

inline bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
inline bool same(Vec3 a, Vec3 b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

/// Expects the statistics after all visits so far, which led to `positions`, to be the host's, bit for bit.
inline void expect_same_statistics(Smoother& device, const Subject& subject, Metric metric, std::span<const Vec3> positions) {
  const auto there = device.statistics();
  ASSERT_TRUE(there.has_value());
  const Statistics here = compute_statistics(subject.input->quality_context(), positions, metric, subject.immovable, nullptr);
  EXPECT_TRUE(same(there->minimum, here.minimum)) << there->minimum << ' ' << here.minimum;
  EXPECT_TRUE(same(there->mean, here.mean)) << there->mean << ' ' << here.mean;
  EXPECT_TRUE(same(there->movable_minimum, here.movable_minimum)) << there->movable_minimum << ' ' << here.movable_minimum;
  EXPECT_TRUE(same(there->ceiling, here.ceiling)) << there->ceiling << ' ' << here.ceiling;
  EXPECT_EQ(there->inverted, here.inverted);
  EXPECT_EQ(there->worst_element, here.worst_element);
}

/// Does an iteration per sweep on both, and compares positions and statistics after each, bit for bit. `task`: of the subject.
inline void expect_same_sweeps(const std::shared_ptr<Queue>& queue, const Subject& subject, const SmoothingTask& task,
                               std::span<const Sweep> sweeps) {
  const auto cpu = make_smoother(task), device = make_device_dmo(queue, task);
  EXPECT_FALSE(device->statistics().has_value()) << "nothing was visited yet";
  std::vector<Vec3> expected = subject.input->mesh.positions, found = expected;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    SCOPED_TRACE("iteration " + std::to_string(i + 1));
    cpu->begin(sweeps[i]);
    device->begin(sweeps[i]);
    const std::uint64_t moved = cpu->visit(0, subject.visits(), expected, nullptr);
    cpu->store(expected, nullptr);
    const std::uint64_t moved_there = device->visit(0, subject.visits(), found, nullptr);
    device->store(found, nullptr);
    for (Index v = 0; v < expected.size(); ++v) ASSERT_TRUE(same(expected[v], found[v])) << "vertex " << v;
    ASSERT_EQ(moved, moved_there);
    expect_same_statistics(*device, subject, task.metric, found);
  }
}
inline void expect_same_visits(const std::shared_ptr<Queue>& queue, const Subject& subject, Metric metric,
                               const SearchParameters& parameters, int iterations, const Sweep& sweep = {}) {
  expect_same_sweeps(queue, subject, subject.task(metric, parameters), std::vector<Sweep>(static_cast<std::size_t>(iterations), sweep));
}

/// Does an iteration per sweep by both, in one call and in calls of `part` visits, and expects the same moves, and the same places at the
/// end.
inline void expect_cuts_change_nothing(Smoother& whole, Smoother& cut, const Subject& subject, std::uint64_t part,
                                       std::span<const Sweep> sweeps) {
  std::vector<Vec3> one = subject.input->mesh.positions, other = one;
  for (const Sweep& sweep : sweeps) {
    whole.begin(sweep);
    cut.begin(sweep);
    const std::uint64_t moved = whole.visit(0, subject.visits(), one, nullptr);
    std::uint64_t in_parts = 0;
    for (std::uint64_t first = 0; first < subject.visits(); first += part)
      in_parts += cut.visit(first, std::min<std::uint64_t>(part, subject.visits() - first), other, nullptr);
    EXPECT_EQ(moved, in_parts);
    EXPECT_GT(moved, 0U);
  }
  whole.store(one, nullptr);
  cut.store(other, nullptr);
  for (Index v = 0; v < one.size(); ++v) ASSERT_TRUE(same(one[v], other[v])) << v;
}

}  // namespace dmoscope::gpu::testing
