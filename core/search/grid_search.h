#pragma once
// The DMO grid search (paper, Algorithm 2): a template over its metric and its lane. A lane is one vertex; its scalar `Real` is double (the
// reference) or float (for speed), and may be a pack of several vertices. For some metrics ratio_search.h finds the same candidate faster.

#include <limits>
#include <type_traits>

#include "core/base/host_device.h"
#include "core/quality/formulas.h"
#include "core/search/candidate_grid.h"
#include "core/search/parameters.h"
#include "core/search/star.h"

namespace dmoscope {

/// Whether the search compares the metric itself or its rank (formulas::rank), which costs less.
enum class Value { Metric, Rank };

namespace formulas {
/// Whether the metric judges elements of the frame other than simplices, and whether its sign tells that they are inverted.
template <Metric M, class Point>
inline constexpr bool kDefinedForOthers = kDefinedForQuadrilaterals<M, Point>;
template <Metric M, class Real>
inline constexpr bool kDefinedForOthers<M, Vec3Of<Real>> = kDefinedForCorners<M>;
template <Metric M, class Point>
inline constexpr bool kSignTellsInversion = Formula<M>::kSeesInversion;
template <Metric M, class Real>
inline constexpr bool kSignTellsInversion<M, Vec3Of<Real>> = true;
}  // namespace formulas

/// Worth of a star with its vertex at one candidate position, element by element. For a star without inverted elements it is the least
/// metric (paper eq. 1); a candidate that inverts one is <= 0 and never wins. Otherwise (Untangling) it is the smallest corner Jacobian
/// over its element's reference measure while that is <= 0, and the least metric once all are positive; every valid candidate is above
/// every invalid one, since valid elements have positive metrics. If volume elements are judged corner by corner, only the corners that the
/// vertex changes count (formulas::metric_around): the best by them is the best by all. Point: Vec2<Real> in a plane, Vec3Of<Real> in
/// space.
template <Metric M, bool Untangling, class Real, Value V, class Point>
class Worth {
 public:
  static constexpr bool kOthers = formulas::kDefinedForOthers<M, Point>;

  DMOSCOPE_ANYWHERE Worth() : quality_(scalar::constant<Real>(std::numeric_limits<float>::max())), jacobian_(quality_) {}
  /// Adds an element of a Star or VolumeStar, with the vertex at `p`.
  template <class Element>
  DMOSCOPE_ANYWHERE void take(const Element& element, Point p) {
    using scalar::min;
    const auto shape = element.with(p);
    quality_ = min(quality_, value(shape, Element::kMoving));
    if constexpr (kNeedsJacobian)
      jacobian_ = min(jacobian_, formulas::smallest_jacobian_around(shape, Element::kMoving) / element.reference);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Real value() const {
    using scalar::select;
    if constexpr (kNeedsJacobian) return select(jacobian_ > Real(0), quality_, jacobian_);
    return quality_;
  }

 private:
  static constexpr bool kNeedsJacobian = Untangling || !formulas::kSignTellsInversion<M, Point>;

  template <class Shape>
  [[nodiscard]] static DMOSCOPE_ANYWHERE Real value(const Shape& shape, Index moving) {
    if constexpr (V == Value::Rank)
      return formulas::rank_around<M>(shape, moving);
    else
      return formulas::metric_around<M>(shape, moving);
  }

  Real quality_, jacobian_;
};

/// The objective: the worth of a star with its vertex at `p`. StarT: StarView or another type with its for_each().
template <Metric M, bool Untangling, class Real, Value V = Value::Metric, class StarT = StarView<Real>>
class Objective {
 public:
  explicit DMOSCOPE_ANYWHERE Objective(StarT star) : star_(star) {}

  template <class Point = Vec2<Real>>
  [[nodiscard]] DMOSCOPE_ANYWHERE Real operator()(Point p) const {
    using At = Worth<M, Untangling, Real, V, Point>;
    At worth;
    star_.template for_each<At::kOthers>([&worth, p](const auto& element) { worth.take(element, p); });
    return worth.value();
  }

 private:
  StarT star_;
};

/// Selects each coordinate by the condition.
template <class Condition, class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec2<Real> select_point(const Condition& condition, Vec2<Real> yes, Vec2<Real> no) {
  using scalar::select;
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y)};
}
template <class Condition, class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Vec3Of<Real> select_point(const Condition& condition, Vec3Of<Real> yes, Vec3Of<Real> no) {
  using scalar::select;
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y), select(condition, yes.z, no.z)};
}

/// Trace that does nothing. Grid inspection passes one that records the steps of the search: the worth of the vertex's own place; the
/// start, if the search has one; then for every level its grid, every candidate, and the best of all so far.
struct NoTrace {
  template <class Real>
  DMOSCOPE_ANYWHERE void begin(const Real& /*objective*/) {}
  template <class Real, class Point>
  DMOSCOPE_ANYWHERE void start(const Candidate<Real, Point>& /*centre of the first grid*/) {}
  template <class Real, class Point>
  DMOSCOPE_ANYWHERE void level(const CandidateGrid<Real, Point>&) {}
  template <class Real, class Point>
  DMOSCOPE_ANYWHERE void candidate(int /*index*/, const Point& /*offset*/, const Real& /*objective*/) {}
  template <class Real, class Point>
  DMOSCOPE_ANYWHERE void found(const Candidate<Real, Point>& /*best*/) {}
};
/// Whether the trace records. A search that does not need every candidate's value computes them only then.
template <class Trace>
inline constexpr bool kTraced = !std::is_same_v<std::remove_cvref_t<Trace>, NoTrace>;

/// Searches all levels and keeps the best candidate. The current position is no candidate (n is even) and so is compared explicitly; only a
/// strictly better candidate replaces it, so ties go to the earlier level and the lower index. Grids after the first are centred on the
/// best position so far, `omega` times 2 / (n - 1) as large as the one before (paper eq. 5). `start`: centre of the first grid, if it is
/// better than the current position. Point: of the plane or of space.
template <class Real, class ObjectiveAt, class Point = Vec2<Real>, class Trace = NoTrace, class Team = Solo>
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Candidate<Real, Point> grid_search(const ObjectiveAt& objective, Point box,
                                                                                   const SearchParameters& parameters, Trace&& trace = {},
                                                                                   const Team& team = {}, const Point* start = nullptr) {
  using scalar::select;
  Candidate<Real, Point> best{{}, Real{}};
  DMOSCOPE_NO_UNROLL  // no unrolling: two copies of the objective in a device's code take long enough to compile
      for (int i = 0; i < (start != nullptr ? 2 : 1); ++i) {
    const Point p = i == 0 ? Point{} : *start;
    const Real value = objective(p);
    if (i == 0) {
      best.objective = value;
      trace.begin(value);
      continue;
    }
    const auto better = value > best.objective;
    best = {select_point(better, p, Point{}), select(better, value, best.objective)};
    trace.start(best);
  }
  double omega = parameters.omega;
  for (int level = 0; level < parameters.levels; ++level) {
    const CandidateGrid<Real, Point> grid{best.offset, times(box, scalar::constant<Real>(omega)), parameters.grid_points};
    trace.level(grid);
    [[maybe_unused]] int index = -1;  // index of the best so far in this level, for teams
    for (int i = static_cast<int>(team.lane()); i < grid.points; i += static_cast<int>(Team::kSize)) {
      grid.for_slice(i, [&](int candidate, const Point& p) DMOSCOPE_INLINE_LAMBDA {
        const Real value = objective(p);
        trace.candidate(candidate, p, value);
        const auto better = value > best.objective;
        best.objective = select(better, value, best.objective);
        best.offset = select_point(better, p, best.offset);
        if constexpr (Team::kSize > 1) index = better ? candidate : index;
      });
    }
    if constexpr (Team::kSize > 1) best = best_of_team(team, best, index);
    trace.found(best);
    omega *= 2.0 / (parameters.grid_points - 1);
  }
  return best;
}

}  // namespace dmoscope
