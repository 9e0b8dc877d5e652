#pragma once
// The kernels' bodies: what one lane does, the same source on a device and on the host that stands in for it.

#include "core/quality/element_shape.h"
#include "core/quality/tally.h"
#include "core/smooth/reference_visit.h"
#include "gpu/fast_visit.h"
#include "gpu/lane.h"
#include "gpu/task.h"
#include "gpu/work.h"

namespace dmoscope::gpu::bodies {

inline constexpr std::size_t kParts = Tally::kLanes, kStretch = Tally::kStretch;

/// Where the vertex stands from now on; it stays awake itself.
inline DMOSCOPE_LANE void move(const Task& task, Index rank, const double* target) {
  task.ranked[rank] = {target[0], target[1], target[2]};
  const std::uint32_t end = task.shapes[rank + 1].first;
  for (std::uint32_t i = task.shapes[rank].first; i < end; ++i) set_flag(task.awake + task.others[i], true);
  (void)increment(task.moved);
}

/// Every body has run(task, i, count, team): lane (or team) i of `count`.
template <Metric M, Stars S>
struct Visit {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& team) {
    const auto rank = static_cast<Index>(task.first + i);
    if (!is_set(task.awake + rank)) return;
    const StarShape shape = task.shapes[rank];
    if constexpr (S != Stars::All)
      if (in_registers<M>(shape, task.parameters) != (S == Stars::Fans)) return;
    using Search = FastVisit<M, Team, S>;
    typename Search::Outcome outcome;
    if (S == Stars::Fans || shape.kind != StarShape::Kind::Alone) outcome = Search(task, rank, team).run();
    if (team.lane() != 0) return;
    using visit_rules::Verdict;
    if (outcome.ready && outcome.verdict == Verdict::Stay) {
      set_flag(task.awake + rank, false);
    } else if (outcome.ready && outcome.verdict == Verdict::Move) {
      move(task, rank, outcome.to.target);
    } else {
      const double* to = outcome.to.target;
      task.deferred[increment(task.deferred_count)] = {rank, outcome.ready, {to[0], to[1], to[2]}};
    }
  }
};

/// The visits that the fast search left, by the plain one in double.
template <Metric M>
struct Settle {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& team) {
    const std::size_t all = *task.deferred_count;
    for (std::size_t k = i; k < all; k += count) {
      Deferred d = task.deferred[k];
      if (!d.has_target) search(task, d, team);
      if (team.lane() == 0) judge(task, d);
    }
  }

 private:
  /// Fills the target.
  template <class Team>
  static DMOSCOPE_LANE void search(const Task& task, Deferred& d, const Team& team) {
    const PositionView positions = positions_of(task);
    const Index vertex = task.vertex_of_rank[d.rank];
    const MeshStar star(task.mesh, positions, vertex);
    const Vec2<double> found = search_star<M>(star, star.box(), task.parameters, team);
    if (found.x == 0.0 && found.y == 0.0) return;
    const Vec3 to =
        displaced(task.mesh.plane, positions[vertex], {found.x * star.scale(), found.y * star.scale()}, task.frame.single_precision);
    d = {d.rank, true, {to.x, to.y, to.z}};
  }

  static DMOSCOPE_LANE void judge(const Task& task, const Deferred& d) {
    const Vec3 target{d.target[0], d.target[1], d.target[2]};
    if (d.has_target && gains_at<M>(task.mesh, positions_of(task), task.vertex_of_rank[d.rank], target))
      move(task, d.rank, d.target);
    else
      set_flag(task.awake + d.rank, false);
  }
};

template <Metric M>
struct Judge {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    const auto element = static_cast<Index>(task.first + i);
    const PositionView positions = positions_of(task);
    visit_planar(
        task.mesh.plane, task.mesh.corners_of(element), [&](Index v) { return positions[v]; },
        [&](const auto& shape) {
          task.quality[element] = evaluate<M>(shape);
          task.inverted[element] = formulas::smallest_jacobian(shape) <= 0.0 ? 1 : 0;
        });
  }
};

/// Part i % kParts of stretch i / kParts. Every comparison with NaN is false: it is left out of minimum, sum and count.
struct Sum {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Part part{0.0, kInfinity, kInfinity, kInfinity, kNoIndex, 0, 0};
    const std::size_t stretch = i / kParts * kStretch;
    const std::size_t end = stretch + kStretch < task.element_count ? stretch + kStretch : task.element_count;
    for (std::size_t e = stretch + i % kParts; e < end; e += kParts) {
      const double quality = task.quality[e];
      const bool is_defined = quality == quality;
      part.sum += is_defined ? quality : 0.0;
      part.defined += is_defined ? 1U : 0U;
      part.inverted += task.inverted[e];
      if (quality < part.minimum) part.minimum = quality, part.worst = static_cast<Index>(e);
      double& bound = task.immovable[e] != 0 ? part.ceiling : part.movable;
      if (quality < bound) bound = quality;
    }
    task.parts[i] = part;
  }
};

struct Total {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t /*i*/, std::size_t /*count*/, const Team& /*team*/) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Part total{0.0, kInfinity, kInfinity, kInfinity, kNoIndex, 0, 0};
    double sums[kParts] = {};
    std::size_t defined = 0;
    const std::size_t parts = (task.element_count + kStretch - 1) / kStretch * kParts;
    for (std::size_t i = 0; i < parts; i += kParts) {
      for (std::size_t lane = 0; lane < kParts; ++lane) {
        const Part part = task.parts[i + lane];
        sums[lane] += part.sum;
        defined += part.defined;
        total.inverted += part.inverted;
        if (part.minimum < total.minimum || (part.minimum == total.minimum && part.worst < total.worst))
          total.minimum = part.minimum, total.worst = part.worst;
        total.movable = scalar::min(total.movable, part.movable);
        total.ceiling = scalar::min(total.ceiling, part.ceiling);
      }
    }
    const double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    const double mean = defined > 0 ? sum / static_cast<double>(defined) : std::numeric_limits<double>::quiet_NaN();
    *task.statistics = {total.minimum, mean, total.movable, total.ceiling, total.worst, total.inverted};
  }
};

struct Load {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    task.ranked[i] = task.positions[task.vertex_of_rank[i]];
    set_flag(task.awake + i, true);
  }
};

struct Store {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    task.positions[i] = task.ranked[task.rank_of_vertex[i]];
  }
};

struct Shade {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    task.shades[i] = shade_of(static_cast<float>(task.quality[i]), task.inverted[i] != 0);
  }
};

struct Count {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    count_one(task.counts + histogram_slot(task.quality[i]));
  }
};

struct Project {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    const Vec2<double> p = task.mesh.plane.project(task.positions[i]);
    task.points[i] = {static_cast<float>(p.x - task.origin.x), static_cast<float>(p.y - task.origin.y)};
  }
};

struct CopyShades {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    task.drawn_shades[i] = task.shades[i];
  }
};

struct Pick {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    task.picked[i] = task.positions[task.wanted[i]];
  }
};

}  // namespace dmoscope::gpu::bodies
