#pragma once
// Promises 1 to 3 of the program, which a run must keep with any method.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/joint/joint_clusters.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/methods/dmo.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::testing {

inline constexpr std::size_t kBudget = std::size_t{1} << 28U;

inline dmoscope::Run make_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters, unsigned threads = 1) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(threads), kBudget};
}

/// Whether a method can optimise a metric there; joint moves need smooth pieces of the metric.
inline bool can_optimise(const MethodInfo& method, Metric metric, const InputMesh& mesh) {
  return !method.joint || why_not_joint(mesh, metric).empty();
}

/// Expects a visit to leave the star no worse, and better if its vertex moved; and the vertex to stay in its plane. With joint moves one
/// star may fall, but not below the value that all of the cluster have reached.
inline void expect_no_worse(const Specimen& specimen, const dmoscope::Run& run, Index vertex, Vec3 old, const StarState& before,
                            const Untangling& rule) {
  const StarState after = star_state(run.input(), run.positions(), run.parameters().metric, vertex);
  if (same_bits(std::span(&old, 1), run.positions().subspan(vertex, 1))) return;
  if (!method_info(run.parameters().method).joint) {
    EXPECT_TRUE(after.better_than(before, rule)) << specimen.name << ": vertex " << vertex << " from " << before.jacobian << ' '
                                                 << before.quality << " to " << after.jacobian << ' ' << after.quality;
  }
  const Vec3 p = run.positions()[vertex], normal = run.input().geometry.plane.normal;
  if (run.input().mesh.single_precision) {
    for (const double x : {p.x, p.y, p.z}) EXPECT_EQ(x, static_cast<float>(x));
  }
  if (run.input().geometry.shape != Shape::Planar) return;
  const double before_along[] = {old.x, old.y, old.z}, along[] = {p.x, p.y, p.z}, across[] = {normal.x, normal.y, normal.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (across[i] != 1.0) continue;  // checks the coordinate that is the same for all vertices
    EXPECT_EQ(std::bit_cast<std::uint64_t>(along[i]), std::bit_cast<std::uint64_t>(before_along[i])) << specimen.name;
  }
}

/// Takes the run through its iterations class by class, and expects no visit to make its star or the mesh worse: the number of inverted
/// elements never rises, and the minimum is never below that at the start of the iteration.
inline void expect_promise_one(const Specimen& specimen, dmoscope::Run& run, std::uint64_t iterations) {
  Progress progress;
  const InputMesh& mesh = run.input();
  Statistics at_start = run.statistics();
  while (run.moment().iteration < iterations) {
    const std::uint64_t visits = run.moment().visits;
    const Index c = static_cast<Index>(std::ranges::find(run.colouring().class_offsets, visits) - run.colouring().class_offsets.begin());
    const auto members = run.colouring().members(c);
    const std::vector<Vec3> old(run.positions().begin(), run.positions().end());
    std::vector<StarState> before;
    for (const Index v : members) before.push_back(star_state(mesh, old, run.parameters().metric, v));
    const Statistics all_before = run.statistics();
    if (visits == 0) at_start = all_before;
    const Untangling rule = run.sweep().untangling;
    // One star may fall in an iteration that moves many vertices together to untangle.
    const bool together =
        visits == 0 && !mesh.is_surface() && untangles_jointly(run.history().records(), run.moment().iteration, mesh.has_strays);
    run.step(StepUnit::Class, progress);
    for (std::size_t i = 0; i < members.size() && !together; ++i)
      expect_no_worse(specimen, run, members[i], old[members[i]], before[i], rule);
    const Statistics all_after = run.statistics();
    EXPECT_LE(all_after.inverted, all_before.inverted) << specimen.name;
    EXPECT_GE(all_after.minimum, at_start.minimum) << specimen.name;
    if (all_before.inverted > 0) continue;
    EXPECT_GE(all_after.minimum, all_before.minimum) << specimen.name;
  }
}

/// Expects promise 1 if the method makes it; others only go on to this iteration.
inline void expect_promise_one_if(bool promised, const Specimen& specimen, dmoscope::Run& run, std::uint64_t iterations) {
  if (promised) return expect_promise_one(specimen, run, iterations);
  Progress progress;
  run.iterate(iterations - run.moment().iteration, progress);
}

inline void expect_fixed_stay(const Specimen& specimen, const dmoscope::Run& run) {
  const std::span<const Vec3> start = run.input().mesh.positions;
  for (Index v = 0; v < start.size(); ++v)
    if (run.fixed()[v] != 0) {
      EXPECT_TRUE(same_bits(start.subspan(v, 1), run.positions().subspan(v, 1))) << specimen.name << ": vertex " << v;
    }
}

inline std::string title(Metric metric) {
  std::string text(info(metric).name);
  std::ranges::replace(text, '-', '_');
  return text;
}

inline std::vector<Metric> all_metrics() {
  std::vector<Metric> metrics;
  for (const MetricInfo& entry : metric_table()) metrics.push_back(entry.metric);
  return metrics;
}

}  // namespace dmoscope::testing
