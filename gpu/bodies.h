#pragma once
// The kernels' bodies: the work of one lane, by the same source on a device and on the host that stands in for it.

#include "core/quality/tally.h"
#include "core/smooth/kernels/fast_visit.h"
#include "core/smooth/reference_visit.h"
#include "gpu/lane.h"
#include "gpu/task.h"
#include "gpu/work.h"

namespace dmoscope::gpu::bodies {

inline constexpr std::size_t kParts = Tally::kLanes, kStretch = Tally::kStretch, kGroup = TallyTotal::kGroup;

/// Moves the vertex and wakes its neighbours; it stays awake itself.
inline DMOSCOPE_LANE void move(const Task& task, Index rank, const double* target) {
  task.ranked[rank] = {target[0], target[1], target[2]};
  const std::uint32_t end = task.shapes[rank + 1].first;
  for (std::uint32_t i = task.shapes[rank].first; i < end; ++i) set_flag(task.awake + task.others[i], true);
  (void)increment(task.moved);
}

/// Makes a visit that the fast search deferred: searches in double by the plain search, by all lanes of a team.
template <Metric M>
struct ExactVisit {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, Deferred d, const Team& team) {
    if (!d.has_target) search(task, d, team);
    if (team.lane() == 0) judge(task, d);
  }

 private:
  /// Searches the star and sets the target of `d`, if there is a better place.
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void search(const Task& task, Deferred& d, const Team& team) {
    const PositionView positions = positions_of(task);
    const Index vertex = task.vertex_of_rank[d.rank];
    const MeshStar<Plane> star(task.mesh, positions, vertex);
    const Vec2<double> found = search_star<M>(star, star.box(), task.parameters, task.untangling, team);
    if (found.x == 0.0 && found.y == 0.0) return;
    const Vec3 to =
        displaced(task.mesh.frame, positions[vertex], {found.x * star.scale(), found.y * star.scale()}, task.frame.single_precision);
    d = {d.rank, true, {to.x, to.y, to.z}};
  }

  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void judge(const Task& task, const Deferred& d) {
    const Vec3 target{d.target[0], d.target[1], d.target[2]};
    if (d.has_target && gains_at<M>(task.mesh, positions_of(task), task.vertex_of_rank[d.rank], target, task.untangling))
      move(task, d.rank, d.target);
    else
      set_flag(task.awake + d.rank, false);
  }
};

/// Visits the vertex of lane (or team) i of `count` by the fast search; every body has such a run(task, i, count, team). AtOnce: visits
/// that the fast search defers are settled in the same lane.
template <Metric M, Stars S, bool AtOnce = false>
struct Visit {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& team) {
    const Index rank = task.listed != nullptr ? task.listed[i] : static_cast<Index>(task.first + i);
    const StarShape shape = task.shapes[rank];
    if constexpr (S != Stars::All)
      if (kind_of_star<M>(shape, task.parameters) != S) return;  // other stars' flags may be written at this moment
    if (!is_set(task.awake + rank)) return;
    using Search = FastVisit<M, Team, S, Task>;
    typename Search::Outcome outcome;
    const bool in_lanes = shape.kind != StarShape::Kind::Alone;
    if (in_lanes && !task.untangling.repair) outcome = Search(task, rank, team).run();
    const double* to = outcome.to.target;
    const Deferred deferred{rank, outcome.ready, {to[0], to[1], to[2]}};
    if constexpr (AtOnce)
      if (!outcome.ready) return ExactVisit<M>::run(task, deferred, team);  // the outcome is the same in all lanes
    if (team.lane() != 0) return;
    using visit_rules::Verdict;
    if (outcome.ready && outcome.verdict == Verdict::Stay)
      set_flag(task.awake + rank, false);
    else if (outcome.ready && outcome.verdict == Verdict::Move)
      move(task, rank, to);
    else if constexpr (AtOnce)
      ExactVisit<M>::run(task, deferred, Solo{});
    else
      task.deferred[increment(task.deferred_count)] = deferred;
  }
};

/// Settles the visits that the fast search deferred.
template <Metric M>
struct Settle {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& team) {
    const std::size_t all = *task.deferred_count;
    for (std::size_t k = i; k < all; k += count) ExactVisit<M>::run(task, task.deferred[k], team);
  }
};

/// Statistics of elements or of parts, added one after the other. Every comparison with NaN is false, so that NaN is left out of minimum,
/// sum and count.
class PartSum {
 public:
  DMOSCOPE_ANYWHERE void add(Index element, double quality, bool inverted, bool immovable) {
    const bool is_defined = quality == quality;
    part_.sum += is_defined ? quality : 0.0;
    part_.defined += is_defined ? 1U : 0U;
    part_.inverted += inverted ? 1U : 0U;
    if (quality < part_.minimum) part_.minimum = quality, part_.worst = element;
    // Plain values, not a reference to either, which would put both into memory on a device.
    part_.ceiling = immovable && quality < part_.ceiling ? quality : part_.ceiling;
    part_.movable = !immovable && quality < part_.movable ? quality : part_.movable;
  }
  DMOSCOPE_ANYWHERE void add(const Part& other) {
    part_.sum += other.sum;
    add_all_but_sum(other);
  }
  /// Adds all that may be added in any order.
  DMOSCOPE_ANYWHERE void add_all_but_sum(const Part& other) {
    part_.defined += other.defined;
    part_.inverted += other.inverted;
    if (other.minimum < part_.minimum || (other.minimum == part_.minimum && other.worst < part_.worst))
      part_.minimum = other.minimum, part_.worst = other.worst;
    part_.movable = scalar::min(part_.movable, other.movable);
    part_.ceiling = scalar::min(part_.ceiling, other.ceiling);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE const Part& part() const { return part_; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Part part_{0.0, kInfinity, kInfinity, kInfinity, kNoIndex, 0, 0, 0};
};

/// Adds up one part of the statistics: part i % kParts of stretch i / kParts.
struct Sum {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    PartSum sum;
    const std::size_t stretch = i / kParts * kStretch;
    std::size_t e = stretch + i % kParts;
    const std::size_t end = stretch + kStretch < task.element_count ? stretch + kStretch : task.element_count;
    for (; e + (kBatch - 1) * kParts < end; e += kBatch * kParts) {
      double quality[kBatch];
      std::uint8_t inverted[kBatch], immovable[kBatch];
      DMOSCOPE_UNROLL
      for (std::size_t b = 0; b < kBatch; ++b) {
        quality[b] = task.quality[e + b * kParts];
        inverted[b] = task.inverted[e + b * kParts];
        immovable[b] = task.immovable[e + b * kParts];
      }
      DMOSCOPE_UNROLL
      for (std::size_t b = 0; b < kBatch; ++b) sum.add(static_cast<Index>(e + b * kParts), quality[b], inverted[b] != 0, immovable[b] != 0);
    }
    for (; e < end; e += kParts) sum.add(static_cast<Index>(e), task.quality[e], task.inverted[e] != 0, task.immovable[e] != 0);
    task.parts[i] = sum.part();
  }

 private:
  static constexpr std::size_t kBatch = 16;  // loads that are waited for together
};

/// Adds up all parts i, i + kParts, ..., group by group, and stores the sum behind them. The lanes of a team load side by side, for the
/// parts are many and the teams few; the first lane adds the sums, one after the other.
struct Total {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& team) {
    static_assert(kGroup % (kBatch * Team::kSize) == 0);
    PartSum all;
    double sum = 0.0, group = 0.0;  // sums over whole groups of stretches, and over the group under way: see TallyTotal
    const std::size_t parts = stretches(task) * kParts;
    for (std::size_t first = i; first < parts; first += kBatch * Team::kSize * kParts) {
      if (first / kParts % kGroup == 0) {
        sum += group;
        group = 0.0;
      }
      Part batch[kBatch];
      DMOSCOPE_UNROLL
      for (std::size_t b = 0; b < kBatch; ++b) {
        const std::size_t k = first + (b * Team::kSize + team.lane()) * kParts;
        batch[b] = task.parts[k < parts ? k : i];
        if (k >= parts) leave_out(batch[b]);
      }
      DMOSCOPE_UNROLL
      for (const Part& part : batch) {
        all.add_all_but_sum(part);
        group = add_in_order(group, part.sum, team);
      }
    }
    sum += group;
    all = fold(team, all, [](PartSum a, const PartSum& b) {
      a.add_all_but_sum(b.part());
      return a;
    });
    if (team.lane() != 0) return;
    task.parts[parts + i] = all.part();
    task.parts[parts + i].sum = sum;
  }
  [[nodiscard]] static DMOSCOPE_ANYWHERE std::size_t stretches(const Task& task) { return (task.element_count + kStretch - 1) / kStretch; }

 private:
  static constexpr std::size_t kBatch = 4;  // loads of a lane that are waited for together

  /// Makes a part add nothing. Sets field by field, for a constant Part would be read from memory.
  static DMOSCOPE_LANE void leave_out(Part& part) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    part.sum = 0.0;
    part.minimum = kInfinity, part.movable = kInfinity, part.ceiling = kInfinity;
    part.worst = kNoIndex, part.inverted = 0, part.defined = 0;
  }

  /// Returns in lane 0 `sum` plus the lanes' values, in the order of lanes. The result in other lanes means nothing.
  template <class Team>
  static DMOSCOPE_LANE double add_in_order(double sum, double value, const Team& team) {
    sum += value;
    if constexpr (Team::kSize > 1) {
      DMOSCOPE_UNROLL
      for (unsigned lane = 1; lane < Team::kSize; ++lane) sum += team.exchange(value, lane);
    }
    return sum;
  }
};

/// Computes the statistics from the totals.
struct Conclude {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t /*i*/, std::size_t /*count*/, const Team& /*team*/) {
    const Part* totals = task.parts + Total::stretches(task) * kParts;
    PartSum all;
    std::size_t defined = 0;
    for (std::size_t lane = 0; lane < kParts; ++lane) {
      all.add(totals[lane]);
      defined += totals[lane].defined;
    }
    const double sum = (totals[0].sum + totals[1].sum) + (totals[2].sum + totals[3].sum);
    const double mean = defined > 0 ? sum / static_cast<double>(defined) : std::numeric_limits<double>::quiet_NaN();
    const Part& found = all.part();
    *task.statistics = {found.minimum, mean, found.movable, found.ceiling, found.worst, found.inverted};
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

/// Counts the histogram. A device counts a block's elements in the block's own memory first: see count_kernel.
struct Count {
  static constexpr std::size_t kCount = kSlotNowhere + 1;
  static constexpr std::size_t kEach = 16;  // elements that a device's lane counts
  [[nodiscard]] static DMOSCOPE_LANE std::size_t of(const Task& task, std::size_t i) { return histogram_slot(task.quality[i]); }
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    count_one(task.counts + of(task, i));
  }
};

struct Project {
  template <class Team>
  static DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& /*team*/) {
    const Vec2<double> p = task.mesh.frame.project(task.positions[i]);
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
