#pragma once
// The kernels' bodies for metrics that are defined by a formula or a target. A visit of a stretch of vertices has four parts: preparing the
// stars, searching the sound ones, searching the tangled ones, and moving the vertices that gain. The results are those of
// core/smooth/methods/defined_dmo.cpp, bit for bit.

#include "core/search/grid_search.h"
#include "gpu/defined/lane_judge.h"
#include "gpu/star_visit.h"

namespace dmoscope::gpu::bodies {

/// Prepares visits: finds the star's state and all numbers that the search's programs are given.
template <class Frame>
struct PrepareDefined {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& /*team*/) {
    const StarSearchTask& search = task.defined.search;
    for (std::size_t visit = i; visit < search.visits; visit += count) prepare(task, search.first + visit, search.star(visit), i);
  }

 private:
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void prepare(const Task& task, std::size_t rank, SoughtStar& star, std::size_t lane) {
    if (task.defined.star_targets == nullptr) star.stage = is_set(task.awake + rank) ? Stage::Waiting : Stage::Over;
    if (star.stage == Stage::Over) return;
    const LaneJudge<Frame> judge(task, lane);
    const Index vertex = task.vertex_of_rank[rank];
    const StarState before = judge.state(vertex, judge.positions()[vertex]);
    task.defined.before[rank - task.defined.search.first_of_stretch] = before;
    if (star.stage == Stage::Found) return;  // found by another search
    const bool tangled = !(before.jacobian > 0.0);
    star.offset[0] = star.offset[1] = star.offset[2] = 0.0;
    star.stage = Stage::Found;
    if (task.untangling.repair && !tangled) return;
    const MeshStar<Frame> around(judge.mesh(), judge.positions(), vertex);
    star.scale = around.scale();
    put(around.box(), star.box);
    star.stage = tangled ? Stage::Tangled : Stage::Sought;
    if (tangled) return;
    const bool movable = task.defined.in_double ? gather<double>(task, judge, vertex, star) : gather<float>(task, judge, vertex, star);
    if (!movable) star.stage = Stage::Found;
  }

  /// Writes the uniform numbers of the star's programs. Returns whether any place can be better than the vertex's own.
  template <class Real>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE bool gather(const Task& task, const LaneJudge<Frame>& judge, Index vertex, SoughtStar& star) {
    const DefinedTask& defined = task.defined;
    const double unit = defined.search.unit_matters ? star.scale : 1.0, per_unit = unit / star.scale;
    const Vec3 here = judge.positions()[vertex];
    Real ceiling = std::numeric_limits<Real>::max(), best = ceiling;
    star.worst = 0;
    const auto elements = judge.mesh().star(vertex);
    for (Index n = 0; n < elements.size(); ++n) {
      const Incidence at = elements[n];
      const ProgramCode& code = defined.program(at.element, at.corner);
      const auto corners = judge.mesh().corners_of(at.element);
      Real* uniforms = static_cast<Real*>(defined.search.numbers) + defined.search.numbers_at[task.mesh.star_offsets[vertex] + n];
      prepare_numbers(
          code,
          [&](const FormulaInput& input) {
            if (input.what == FormulaInput::What::Corner)
              return coordinate(judge.mesh().frame.offset(judge.positions()[corners[input.index]], here), input.row) * per_unit;
            if (input.what == FormulaInput::What::Origin) return coordinate(judge.mesh().frame.project(here), input.row);
            return defined.number(input, at.element, star.scale / unit);
          },
          uniforms);
      if (code.ceiling != ProgramCode::kNoCeiling && uniforms[code.ceiling] < ceiling) ceiling = uniforms[code.ceiling];
      const Real worth =
          ProgramRun<Real>(code, uniforms, judge.template registers<Real>()).run([](const FormulaInput& /*input*/) { return Real(0); });
      if (worth < best) {
        best = worth;
        star.worst = n;
      }
    }
    star.best = static_cast<double>(best);
    return !(ceiling <= best);
  }

  static DMOSCOPE_LANE void put(Vec2<double> p, double* to) { to[0] = p.x, to[1] = p.y, to[2] = 0.0; }
  static DMOSCOPE_LANE void put(Vec3 p, double* to) { to[0] = p.x, to[1] = p.y, to[2] = p.z; }
};

/// Programs that a lane runs step by step.
template <class Real, class Point>
class SteppedPrograms {
 public:
  DMOSCOPE_LANE explicit SteppedPrograms(const DefinedTask& task) : task_(task) {}
  [[nodiscard]] DMOSCOPE_LANE Real run(std::size_t program, const Real* uniforms, const Point& at, std::size_t lane) const {
    return ProgramRun<Real>(task_.programs[program], uniforms, task_.registers_of<Real>(lane)).run([&at](const FormulaInput& input) {
      if constexpr (std::is_same_v<Point, Vec2<Real>>)
        return input.row == 0 ? at.x : at.y;
      else
        return input.row == 0 ? at.x : input.row == 1 ? at.y : at.z;
    });
  }

 private:
  const DefinedTask& task_;
};

/// Searches sound stars, each by a team.
template <class Frame, class Real>
struct SearchDefined {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& team) {
    using Point = OffsetIn<Frame, Real>;
    using Programs = SteppedPrograms<Real, Point>;
    StarSearch<Real, Point, Programs, Team>::run(task.defined.search, Programs(task.defined), i, count, team);
  }
};

/// Searches tangled stars, each by a team.
template <class Frame>
struct UntangleDefined {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& team) {
    const StarSearchTask& search = task.defined.search;
    for (std::size_t visit = i; visit < search.visits; visit += count) {
      SoughtStar& star = search.star(visit);
      if (star.stage != Stage::Tangled) continue;
      const LaneJudge<Frame> judge(task, i * Team::kSize + team.lane());
      const Index vertex = task.vertex_of_rank[search.first + visit];
      const MeshStar<Frame> around(judge.mesh(), judge.positions(), vertex);
      const auto found = untangle(task, DefinedLaneStar<Frame>(judge, around, vertex), around.box(), team);
      if (team.lane() != 0) continue;
      star.offset[0] = found.x, star.offset[1] = found.y;
      if constexpr (std::is_same_v<Frame, Space>) star.offset[2] = found.z;
      star.stage = Stage::Found;
    }
  }

 private:
  using Offset = OffsetIn<Frame, double>;
  /// Returns the offset in units of the star's scale: see search_star().
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE Offset untangle(const Task& task, const DefinedLaneStar<Frame>& star, Offset box,
                                                            const Team& team) {
    const UntanglingObjective<kDefinedMetric, DefinedLaneStar<Frame>, Offset> untangling(star, task.untangling);
    if (!untangling.tangled()) {
      if (task.untangling.repair) return {};
      return grid_search<double>(star, box, task.parameters, NoTrace{}, team).offset;
    }
    const Offset middle = star.middle();
    return grid_search<double>(untangling, box, task.parameters, NoTrace{}, team, &middle).offset;
  }
};

/// Ends visits: moves the vertices that gain, and puts the others to sleep.
template <class Frame>
struct SettleDefined {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& /*team*/) {
    const StarSearchTask& search = task.defined.search;
    for (std::size_t visit = i; visit < search.visits; visit += count)
      if (search.star(visit).stage == Stage::Found) settle(task, search.first + visit, search.star(visit), i);
  }

 private:
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void settle(const Task& task, std::size_t rank, const SoughtStar& star, std::size_t lane) {
    const LaneJudge<Frame> judge(task, lane);
    const Index vertex = task.vertex_of_rank[rank];
    const auto offset = times(offset_of(star), star.scale);
    bodies::settle(task, judge.mesh(), static_cast<Index>(rank), offset, [&](Vec3 to) DMOSCOPE_INLINE_LAMBDA {
      return confirm_from(judge.mesh(), judge.positions(), vertex, to, task.untangling,
                          task.defined.before[rank - task.defined.search.first_of_stretch],
                          [&]() DMOSCOPE_INLINE_LAMBDA { return judge.state(vertex, to); });
    });
  }
  [[nodiscard]] static DMOSCOPE_LANE OffsetIn<Frame, double> offset_of(const SoughtStar& star) {
    if constexpr (std::is_same_v<Frame, Plane>)
      return {star.offset[0], star.offset[1]};
    else
      return {star.offset[0], star.offset[1], star.offset[2]};
  }
};

/// Judges elements i, i + count, ...: their quality and whether they are inverted.
template <class Frame>
struct JudgeDefined {
  template <class Team>
  static DMOSCOPE_LANE_INLINE DMOSCOPE_LANE void run(const Task& task, std::size_t i, std::size_t count, const Team& /*team*/) {
    const LaneJudge<Frame> judge(task, i);
    const auto at = [&](Index v) { return judge.positions()[v]; };
    for (std::size_t e = i; e < task.element_count; e += count) {
      const auto element = static_cast<Index>(e);
      task.quality[e] = judge.quality(element, kNoIndex, at);
      task.inverted[e] = visit_shape(judge.mesh().frame_of(element), judge.mesh().corners_of(element), at,
                                     [](const auto& shape) { return least_jacobian(shape) <= 0.0; })
                             ? 1
                             : 0;
    }
  }
};

}  // namespace dmoscope::gpu::bodies
