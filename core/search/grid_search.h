#pragma once
// The DMO grid search (paper, Algorithm 2): a template over its metric and its lane. A lane is one vertex; its scalar `Real` is double (the
// reference) or float (for speed), and may be a pack that holds several vertices. ratio_search.h finds the same candidate faster where
// the metric allows it.

#include <limits>
#include <type_traits>

#include "core/base/anywhere.h"
#include "core/quality/formulas.h"
#include "core/search/parameters.h"
#include "core/search/star.h"
#include "core/search/team.h"

namespace dmoscope {

/// Does the search compare the metric itself or its rank (formulas::rank), which costs less?
enum class Value { Metric, Rank };

/// What a star is worth with its vertex at one candidate position, element by element.
/// A star without inverted elements: the least metric (paper eq. 1); a candidate that inverts one is <= 0 and never wins.
/// Otherwise (Untangling): the smallest corner Jacobian over its element's reference measure while it is <= 0, and the least metric
/// once all are positive; every valid candidate is above every invalid one, since valid elements have positive metrics.
template <Metric M, bool Untangling, class Real, Value V>
class Worth {
 public:
  static constexpr bool kQuadrilaterals = formulas::kDefinedForQuadrilaterals<M, Vec2<Real>>;

  DMOSCOPE_ANYWHERE Worth() : quality_(scalar::constant<Real>(std::numeric_limits<float>::max())), jacobian_(quality_) {}
  DMOSCOPE_ANYWHERE void take(const StarTriangle<Real>& t, Vec2<Real> p) { take(formulas::Triangle<Vec2<Real>>(p, t.b, t.c), t.reference); }
  DMOSCOPE_ANYWHERE void take(const StarQuadrilateral<Real>& q, Vec2<Real> p) {
    take(formulas::Quadrilateral<Vec2<Real>>(p, q.b, q.c, q.d), q.reference);
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE Real value() const {
    using scalar::select;
    if constexpr (kNeedsJacobian) return select(jacobian_ > Real(0), quality_, jacobian_);
    return quality_;
  }

 private:
  static constexpr bool kNeedsJacobian = Untangling || !formulas::Formula<M>::kSeesInversion;

  template <class Shape>
  DMOSCOPE_ANYWHERE void take(const Shape& shape, [[maybe_unused]] Real reference) {
    using scalar::min;
    quality_ = min(quality_, value(shape));
    if constexpr (kNeedsJacobian) jacobian_ = min(jacobian_, formulas::smallest_jacobian(shape) / reference);
  }
  template <class Shape>
  [[nodiscard]] static DMOSCOPE_ANYWHERE Real value(const Shape& shape) {
    if constexpr (V == Value::Rank)
      return formulas::rank<M>(shape);
    else
      return formulas::metric<M>(shape);
  }

  Real quality_, jacobian_;
};

/// What is maximised: the worth of a star with its vertex at `p`. StarT: StarView or what else has its for_each().
template <Metric M, bool Untangling, class Real, Value V = Value::Metric, class StarT = StarView<Real>>
class Objective {
 public:
  explicit DMOSCOPE_ANYWHERE Objective(StarT star) : star_(star) {}

  [[nodiscard]] DMOSCOPE_ANYWHERE Real operator()(Vec2<Real> p) const {
    using At = Worth<M, Untangling, Real, V>;
    At worth;
    star_.template for_each<At::kQuadrilaterals>([&worth, p](const auto& element) { worth.take(element, p); });
    return worth.value();
  }

 private:
  StarT star_;
};

/// The best candidate of all levels: its offset from the vertex (units of the star's scale) and its objective.
template <class Real>
struct Candidate {
  Vec2<Real> offset{};
  Real objective{};
};

/// One level's grid: candidate (i, j), 0 <= i, j < n, is centre + ((i, j) / (n - 1) - 1/2) * size; its index is i * n + j.
template <class Real>
struct CandidateGrid {
  Vec2<Real> centre{};
  Vec2<Real> size{};
  int points = 0;
  [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<Real> at(int i, int j) const {
    return {coordinate(centre.x, size.x, i), coordinate(centre.y, size.y, j)};
  }

 private:
  [[nodiscard]] DMOSCOPE_ANYWHERE Real coordinate(Real middle, Real width, int i) const {
    return middle + width * (scalar::constant<Real>(i) / scalar::constant<Real>(points - 1) - Real(0.5F));
  }
};

/// Does nothing at each step of the search; grid inspection passes one that records: what the vertex's own place is worth; then for every
/// level its grid, every candidate, and the best of all so far.
struct NoTrace {
  template <class Real>
  DMOSCOPE_ANYWHERE void begin(const Real& /*objective*/) {}
  template <class Real>
  DMOSCOPE_ANYWHERE void level(const CandidateGrid<Real>&) {}
  template <class Real>
  DMOSCOPE_ANYWHERE void candidate(int /*index*/, Vec2<Real> /*offset*/, Real /*objective*/) {}
  template <class Real>
  DMOSCOPE_ANYWHERE void found(const Candidate<Real>& /*best*/) {}
};
/// Does somebody look? A search that needs no candidate's value for itself finds them only then.
template <class Trace>
inline constexpr bool kTraced = !std::is_same_v<std::remove_cvref_t<Trace>, NoTrace>;

/// The best of a team's lanes; among equals the one of lowest index.
template <class Real, class Team>
[[nodiscard]] DMOSCOPE_ANYWHERE Candidate<Real> best_of_team(const Team& team, const Candidate<Real>& mine, int index) {
  struct Found {
    Candidate<Real> candidate;
    int index;
  };
  return fold(team, Found{mine, index},
              [](const Found& a, const Found& b) {
                const bool second =
                    b.candidate.objective > a.candidate.objective || (b.candidate.objective == a.candidate.objective && b.index < a.index);
                return second ? b : a;
              })
      .candidate;
}

/// Searches all levels and keeps the best of all. The current position is no candidate (n is even) and so is compared explicitly;
/// only a strictly better candidate replaces it, so ties go to the earlier level and the lower index. Grids after the first are
/// centred on the best position so far, `omega` times 2 / (n - 1) as large as the one before (paper eq. 5).
template <class Real, class ObjectiveAt, class Trace = NoTrace, class Team = Solo>
[[nodiscard]] DMOSCOPE_ANYWHERE Candidate<Real> grid_search(const ObjectiveAt& objective, Vec2<Real> box,
                                                            const SearchParameters& parameters, Trace&& trace = {}, const Team& team = {}) {
  using scalar::select;
  Candidate<Real> best{{}, objective(Vec2<Real>{})};
  trace.begin(best.objective);
  double omega = parameters.omega;
  for (int level = 0; level < parameters.levels; ++level) {
    const Real factor = scalar::constant<Real>(omega);
    const CandidateGrid<Real> grid{best.offset, {box.x * factor, box.y * factor}, parameters.grid_points};
    trace.level(grid);
    [[maybe_unused]] int index = -1;  // of the best so far in this level: for a team alone
    for (int i = static_cast<int>(team.lane()); i < grid.points; i += static_cast<int>(Team::kSize)) {
      for (int j = 0; j < grid.points; ++j) {
        const Vec2<Real> p = grid.at(i, j);
        const Real value = objective(p);
        trace.candidate(i * grid.points + j, p, value);
        const auto better = value > best.objective;
        best.objective = select(better, value, best.objective);
        best.offset = {select(better, p.x, best.offset.x), select(better, p.y, best.offset.y)};
        if constexpr (Team::kSize > 1) index = better ? i * grid.points + j : index;
      }
    }
    if constexpr (Team::kSize > 1) best = best_of_team(team, best, index);
    trace.found(best);
    omega *= 2.0 / (parameters.grid_points - 1);
  }
  return best;
}

}  // namespace dmoscope
