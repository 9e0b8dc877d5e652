#pragma once
// The kernels' bodies for the mean ratio against targets: the searches of core/smooth/kernels/targets/target_lane_kernel_impl.h and
// target_volume_kernel_impl.h. They run before the parts of a visit in gpu/defined/bodies.h and leave the other stars to these.

#include "core/smooth/kernels/solid_target.h"
#include "core/smooth/kernels/targets/target_visit.h"
#include "gpu/bodies.h"
#include "gpu/defined/lane_judge.h"
#include "gpu/star_visit.h"
#include "gpu/volume_search.h"

namespace dmoscope::gpu::bodies {

/// Visits planar stars, each by a team: moves the vertices that gain.
template <bool Crossed>
struct VisitTargets {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& team) {
    const StarSearchTask& search = task.defined.search;
    for (std::size_t visit = i; visit < search.visits; visit += count) {
      const auto rank = static_cast<Index>(search.first + visit);
      SoughtStar& star = search.star(visit);
      const bool awake = is_set(task.awake + rank), alone = task.shapes[rank].kind == StarShape::Kind::Alone;
      typename TargetVisit<Crossed, Task, Team>::Outcome outcome;
      if (awake && !alone && !task.untangling.repair) {
        const double* targets = task.defined.star_targets + target_numbers(Crossed) * std::size_t{task.defined.first_target[rank]};
        outcome = TargetVisit<Crossed, Task, Team>(task, rank, targets, team).run();
      }
      if (team.lane() != 0) continue;
      star.stage = awake && !outcome.ready ? Stage::Waiting : Stage::Over;
      if (outcome.ready) settle(task, rank, outcome.verdict, outcome.to.target, i * Team::kSize);
    }
  }

 private:
  static DMOSCOPE_LANE void settle(const Task& task, Index rank, visit_rules::Verdict verdict, const double* to, std::size_t lane) {
    using visit_rules::Verdict;
    if (verdict == Verdict::Move || (verdict == Verdict::MoveIfExact && gains(task, rank, {to[0], to[1], to[2]}, lane)))
      move(task, rank, to);
    else
      set_flag(task.awake + rank, false);
  }
  /// Whether the vertex gains at `to`, by the statistics' programs.
  [[nodiscard]] static DMOSCOPE_LANE bool gains(const Task& task, Index rank, Vec3 to, std::size_t lane) {
    const LaneJudge<Plane> judge(task, lane);
    const Index vertex = task.vertex_of_rank[rank];
    StarState states[2];
    DMOSCOPE_NO_UNROLL  // a program is long
        for (int i = 0; i < 2; ++i) states[i] = judge.state(vertex, i == 0 ? judge.positions()[vertex] : to);
    const Confirmation found = confirm_from(judge.mesh(), judge.positions(), vertex, to, task.untangling, states[0],
                                            [&]() DMOSCOPE_INLINE_LAMBDA { return states[1]; });
    return found == Confirmation::Gains;
  }
};

/// Ranks of a star of tetrahedra with targets.
template <bool Crossed, class Team>
class TargetRanks {
 public:
  DMOSCOPE_LANE_INLINE DMOSCOPE_LANE TargetRanks(const Task& task, const MeshStar<Space>& star, Index vertex, const Team& team)
      : star_(star), elements_(volume_of(task).star(vertex)), targets_(task.defined.star_targets) {
    if constexpr (HasScratch<Team>) stage(team);
  }

  DMOSCOPE_LANE void rank(SomeCandidates& some) const {
    DMOSCOPE_UNROLL
    for (float& worth : some.worth) worth = std::numeric_limits<float>::max();
    if constexpr (HasScratch<Team>) {
      for (unsigned i = 0; i < staged_; ++i) lower(some, stage_[i]);
      if (staged_ > 0) return;
    }
    for (const Incidence& at : elements_) lower(some, form_of(at));
  }

 private:
  using Form = std::conditional_t<Crossed, volumes::StretchedForm<float>, volumes::MeanRatioForm<float>>;

  DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void stage(const Team& team) {
    static_assert(Team::kScratchBytes >= kStaged * sizeof(Form));
    stage_ = static_cast<Form*>(team.scratch());
    if (elements_.size() > kStaged) return;
    staged_ = static_cast<unsigned>(elements_.size());
    team.meet();  // all lanes have read the star before it
    for (unsigned i = team.lane(); i < staged_; i += Team::kSize) stage_[i] = form_of(elements_[i]);
    team.meet();
  }
  static DMOSCOPE_LANE void lower(SomeCandidates& some, const Form& form) {
    DMOSCOPE_UNROLL
    for (int i = 0; i < SomeCandidates::kCount; ++i) {
      const Vec3Of<float> p = some.at[i];
      some.worth[i] = scalar::min(some.worth[i], volumes::rank_of(form, p, dot(p, p)));
    }
  }
  [[nodiscard]] DMOSCOPE_LANE Form form_of(const Incidence& at) const {
    const double* g = targets_ + volumes::solid_target_numbers(Crossed) * at.element;
    volumes::TargetTetrahedron<float> t{};
    const auto place = [&t](const StarTetrahedron<double>& e) { t.at[0] = narrow(e.b), t.at[1] = narrow(e.c), t.at[2] = narrow(e.d); };
    star_.template visit<false>(at, place);
    DMOSCOPE_UNROLL
    for (Index k = 0; k < 3; ++k) t.rows[k] = narrow(row_of(g, turned::tetrahedron(at.corner, k + 1)));
    if constexpr (Crossed)
      t.stretch = {static_cast<float>(g[6]), static_cast<float>(g[7]),  static_cast<float>(g[8]),
                   static_cast<float>(g[9]), static_cast<float>(g[10]), static_cast<float>(g[11])};
    return volumes::target_form<Crossed>(t);
  }
  /// The row of W^-1 that belongs to corner `corner` of an element.
  [[nodiscard]] static DMOSCOPE_LANE Vec3 row_of(const double* g, Index corner) {
    if (corner == 0) return {-(g[0] + g[1] + g[3]), -(g[2] + g[4]), -g[5]};
    if (corner == 1) return {g[0], 0.0, 0.0};
    if (corner == 2) return {g[1], g[2], 0.0};
    return {g[3], g[4], g[5]};
  }

  const MeshStar<Space>& star_;
  std::span<const Incidence> elements_;
  const double* targets_;
  Form* stage_ = nullptr;  // the team's memory, and how much of it is used
  unsigned staged_ = 0;
};

/// Size of a team's memory, in bytes.
inline constexpr std::size_t kTargetStageBytes = kStaged * sizeof(volumes::StretchedForm<float>);

/// Searches stars of tetrahedra, each by a team: finds the offset where the star is best.
template <bool Crossed>
struct SearchTargets {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& team) {
    const StarSearchTask& search = task.defined.search;
    for (std::size_t visit = i; visit < search.visits; visit += count) {
      const std::size_t rank = search.first + visit;
      SoughtStar& star = search.star(visit);
      const bool awake = is_set(task.awake + rank);
      const Index vertex = task.vertex_of_rank[rank];
      VolumeFound found;
      double scale = 1.0;
      if (awake && !task.untangling.repair && fits(task, vertex)) {
        const MeshStar<Space> around(volume_of(task), positions_of(task), vertex);
        scale = around.scale();
        const TargetRanks<Crossed, Team> ranks(task, around, vertex, team);
        found = VolumeLevels<TargetRanks<Crossed, Team>, Team>(ranks, narrow(around.box()), task.parameters, team).run();
      }
      if (team.lane() != 0) continue;
      star.stage = !awake ? Stage::Over : found.ready ? Stage::Found : Stage::Waiting;
      star.scale = scale;
      star.offset[0] = static_cast<double>(found.offset.x);
      star.offset[1] = static_cast<double>(found.offset.y);
      star.offset[2] = static_cast<double>(found.offset.z);
    }
  }

 private:
  /// Whether it is a star of tetrahedra whose targets floats hold, of at most kMaxSolids elements.
  [[nodiscard]] static DMOSCOPE_LANE bool fits(const Task& task, Index vertex) {
    const auto star = volume_of(task).star(vertex);
    bool all = star.size() <= kMaxSolids;
    for (const Incidence& at : star) all = all && task.defined.fits[at.element] != 0;
    return all;
  }
};

}  // namespace dmoscope::gpu::bodies
