#pragma once
// The kernels' bodies for two aims: combined metrics, and the phase that raises the mean. Visit does the same on the processor.

#include "core/smooth/composite_visit.h"
#include "gpu/lane.h"
#include "gpu/listed_star.h"
#include "gpu/star_visit.h"
#include "gpu/task.h"

namespace dmoscope::gpu::bodies {

/// Calls f.template operator()<M>() with a metric that is defined in the frame.
template <class Frame, class F>
DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE decltype(auto) with_metric_in(Metric metric, F&& f) {
  if constexpr (std::is_same_v<Frame, Plane>)
    return formulas::with_planar_metric(metric, f);
  else
    return formulas::with_volume_metric(metric, f);
}

/// The number that the search maximises: see StarScore.
template <Metric M, class Frame>
class CompositeLaneScore {
 public:
  using Offset = OffsetIn<Frame, double>;
  using StarT = ListedStar<Frame>;
  DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE CompositeLaneScore(const PlainComposite& aims, const StarT& star, const Untangling& rule,
                                                            const DensityTarget<Frame>& target)
      : aims_(aims), star_(star), target_(target), untangling_(star, rule) {}

  [[nodiscard]] DMOSCOPE_ANYWHERE bool tangled() const { return untangling_.tangled(); }
  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE double operator()(Offset p) const {
    const double least = tangled() ? untangling_(p) : least_of<M>(p);
    return aims_.beyond(least) ? aims_.threshold + second(p) : least;
  }

 private:
  template <Metric S>
  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE double least_of(Offset p) const {
    return Objective<S, false, double, Value::Metric, const StarT&>(star_)(p);
  }
  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE double second(Offset p) const {
    if (aims_.second == PlainComposite::Second::Density) return target_.density(p);
    if (aims_.second == PlainComposite::Second::Mean) return mean_of<M>(star_, p, aims_.mean);
    double least = std::numeric_limits<float>::max();  // the start value of Worth, too
    star_.template for_each<true>([&](const auto& element) { least = scalar::min(least, worth_of(element, p)); });
    return least;
  }
  /// Value of the second metric for one element. The metric is chosen element by element, so that the code that reads an element is there
  /// once; the least of these values is the value of an Objective of the metric, for a sound element is worth more than any that is not.
  template <class Element>
  [[nodiscard]] DMOSCOPE_LANE_INLINE DMOSCOPE_ANYWHERE double worth_of(const Element& element, Offset p) const {
    return with_metric_in<Frame>(aims_.metric, [&]<Metric S>() DMOSCOPE_INLINE_LAMBDA {
      Worth<S, false, double, Value::Metric, Offset> worth;
      if constexpr (decltype(worth)::kOthers || kListOf<Element> == 0) worth.take(element, p);
      return worth.value();
    });
  }

  const PlainComposite& aims_;
  const StarT& star_;
  DensityTarget<Frame> target_;  // in units of the star's scale
  UntanglingObjective<M, const StarT&, Offset> untangling_;
};

/// Visits the vertex of rank first + i by the plain search in double, by all lanes of a team.
template <Metric M, class Frame>
struct VisitComposite {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t /*count*/, const Team& team) {
    const auto rank = static_cast<Index>(task.first + i);
    if (!is_set(task.awake + rank)) return;
    const MeshView<Frame> mesh = mesh_in<Frame>(task);
    const Index vertex = task.vertex_of_rank[rank];
    const ListedStar<Frame> star(mesh, positions_of(task), vertex);
    const Offset found = search(task, rank, star, team);
    if (team.lane() != 0) return;
    settle(task, mesh, rank, times(found, star.star().scale()),
           [&](Vec3 to) DMOSCOPE_INLINE_LAMBDA { return confirm(task, mesh, vertex, to); });
  }

 private:
  using Offset = OffsetIn<Frame, double>;

  /// Returns the offset of the best candidate in units of the star's scale; 0 if none is better than the vertex's own place.
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE Offset search(const Task& task, Index rank, const ListedStar<Frame>& star, const Team& team) {
    const CompositeLaneScore<M, Frame> score(task.aims, star, task.untangling,
                                             density_of(task, task.vertex_of_rank[rank], star.star().scale()));
    if (task.untangling.repair && !score.tangled()) return {};
    const Offset middle = score.tangled() ? middle_of<Offset>(star) : Offset{};
    return grid_search<double>(score, star.star().box(), task.parameters, NoTrace{}, team, score.tangled() ? &middle : nullptr).offset;
  }
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE DensityTarget<Frame> density_of(const Task& task, Index vertex, double scale) {
    if constexpr (std::is_same_v<Frame, Plane>)
      if (task.aims.second == PlainComposite::Second::Density) return wanted(task, vertex).in_units(scale);
    return {};  // a size function exists for planar meshes alone
  }
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE DensityTarget<Plane> wanted(const Task& task, Index vertex) {
    return density_target_by(task.mesh, positions_of(task), vertex, [&task](Index /*vertex*/, Vec3 place) DMOSCOPE_INLINE_LAMBDA {
      return task.aims.size.at(task.mesh.frame, place);
    });
  }

  /// Judges the star at both places in a loop, so that there is one copy of the code that judges a star.
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE Confirmation confirm(const Task& task, const MeshView<Frame>& mesh, Index vertex, Vec3 target) {
    const PositionView positions = positions_of(task);
    StarState before, after;
    DMOSCOPE_NO_UNROLL
    for (int i = 0; i < 2; ++i) {
      before = after;
      after = star_state<M>(mesh, positions, vertex, i == 0 ? positions[vertex] : target);
    }
    return confirm_composite(
        task.aims, before, after, task.untangling,
        [&](bool tangled) DMOSCOPE_INLINE_LAMBDA { return confirm_soundness(mesh, positions, vertex, target, tangled); },
        [&]() DMOSCOPE_INLINE_LAMBDA { return second_rises(task, mesh, vertex, target); });
  }
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE bool second_rises(const Task& task, const MeshView<Frame>& mesh, Index vertex, Vec3 target) {
    double here = 0.0, there = 0.0;
    DMOSCOPE_NO_UNROLL
    for (int i = 0; i < 2; ++i) {
      here = there;
      there = second(task, mesh, vertex, i == 0 ? positions_of(task)[vertex] : target);
    }
    return there > here;
  }
  /// Value of the second aim with the vertex at `place`, by the statistics' formulas.
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE double second(const Task& task, const MeshView<Frame>& mesh, Index vertex, Vec3 place) {
    const PositionView positions = positions_of(task);
    if constexpr (std::is_same_v<Frame, Plane>)
      if (task.aims.second == PlainComposite::Second::Density)
        return wanted(task, vertex).density(mesh.frame.offset(place, positions[vertex]));
    if (task.aims.raise_mean()) return mean_at_place<M>(mesh, positions, vertex, place, task.aims.mean);
    return with_metric_in<Frame>(task.aims.metric,
                                 [&]<Metric S>() DMOSCOPE_INLINE_LAMBDA { return star_state<S>(mesh, positions, vertex, place).quality; });
  }
};

}  // namespace dmoscope::gpu::bodies
