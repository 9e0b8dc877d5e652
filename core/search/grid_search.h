#pragma once
// The DMO grid search (paper, Algorithm 2): a template over its metric and its lane. A lane is one vertex; its scalar `Real` is double (the
// reference) or float (for speed), and may be a pack that holds several vertices. ratio_search.h finds the same candidate faster where
// the metric allows it.

#include <limits>

#include "core/quality/formulas.h"
#include "core/search/parameters.h"
#include "core/search/star.h"

namespace dmoscope {

/// Does the search compare the metric itself or its rank (formulas::rank), which costs less?
enum class Value { Metric, Rank };

/// What is maximised at a candidate position.
/// A star without inverted elements: the least metric (paper eq. 1); a candidate that inverts one is <= 0 and never wins.
/// Otherwise (Untangling): the smallest corner Jacobian over its element's reference measure while it is <= 0, and the least metric
/// once all are positive; every valid candidate is above every invalid one, since valid elements have positive metrics.
template <Metric M, bool Untangling, class Real, Value V = Value::Metric>
class Objective {
 public:
  explicit Objective(StarView<Real> star) : star_(star) {}

  [[nodiscard]] Real operator()(Vec2<Real> p) const {
    using scalar::min, scalar::select;
    Real quality = scalar::constant<Real>(std::numeric_limits<float>::max());
    Real jacobian = scalar::constant<Real>(std::numeric_limits<float>::max());
    for (const auto& t : star_.triangles()) {
      const formulas::Triangle<Vec2<Real>> triangle(p, t.b, t.c);
      quality = min(quality, value(triangle));
      if constexpr (kNeedsJacobian) jacobian = min(jacobian, formulas::smallest_jacobian(triangle) / t.reference);
    }
    if constexpr (kQuadrilaterals) {
      for (const auto& q : star_.quadrilaterals()) {
        const formulas::Quadrilateral<Vec2<Real>> quadrilateral(p, q.b, q.c, q.d);
        quality = min(quality, value(quadrilateral));
        if constexpr (kNeedsJacobian) jacobian = min(jacobian, formulas::smallest_jacobian(quadrilateral) / q.reference);
      }
    }
    if constexpr (kNeedsJacobian) return select(jacobian > Real(0), quality, jacobian);
    return quality;
  }

 private:
  [[nodiscard]] static Real value(const formulas::Triangle<Vec2<Real>>& t) {
    if constexpr (V == Value::Rank)
      return formulas::rank<M>(t);
    else
      return formulas::Formula<M>::triangle(t);
  }
  [[nodiscard]] static Real value(const formulas::Quadrilateral<Vec2<Real>>& q) {
    if constexpr (V == Value::Rank)
      return formulas::rank<M>(q);
    else
      return formulas::Formula<M>::quadrilateral(q);
  }
  static constexpr bool kQuadrilaterals = formulas::kDefinedForQuadrilaterals<M, Vec2<Real>>;
  static constexpr bool kNeedsJacobian = Untangling || !formulas::Formula<M>::kSeesInversion;
  StarView<Real> star_;
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
  [[nodiscard]] Vec2<Real> at(int i, int j) const { return {coordinate(centre.x, size.x, i), coordinate(centre.y, size.y, j)}; }

 private:
  [[nodiscard]] Real coordinate(Real middle, Real width, int i) const {
    return middle + width * (scalar::constant<Real>(i) / scalar::constant<Real>(points - 1) - Real(0.5F));
  }
};

/// Does nothing at each step of the search; grid inspection passes one that records.
struct NoTrace {
  template <class Real>
  void level(const CandidateGrid<Real>&) {}
  template <class Real>
  void candidate(int /*index*/, Vec2<Real> /*offset*/, Real /*objective*/) {}
};

/// Searches all levels and keeps the best of all. The current position is no candidate (n is even) and so is compared explicitly;
/// only a strictly better candidate replaces it, so ties go to the earlier level and the lower index. Grids after the first are
/// centred on the best position so far, `omega` times 2 / (n - 1) as large as the one before (paper eq. 5).
template <class Real, class ObjectiveAt, class Trace = NoTrace>
[[nodiscard]] Candidate<Real> grid_search(const ObjectiveAt& objective, Vec2<Real> box, const SearchParameters& parameters,
                                          Trace&& trace = {}) {
  using scalar::select;
  Candidate<Real> best{{}, objective(Vec2<Real>{})};
  double omega = parameters.omega;
  for (int level = 0; level < parameters.levels; ++level) {
    const Real factor = scalar::constant<Real>(omega);
    const CandidateGrid<Real> grid{best.offset, {box.x * factor, box.y * factor}, parameters.grid_points};
    trace.level(grid);
    for (int i = 0; i < grid.points; ++i) {
      for (int j = 0; j < grid.points; ++j) {
        const Vec2<Real> p = grid.at(i, j);
        const Real value = objective(p);
        trace.candidate(i * grid.points + j, p, value);
        const auto better = value > best.objective;
        best.objective = select(better, value, best.objective);
        best.offset = {select(better, p.x, best.offset.x), select(better, p.y, best.offset.y)};
      }
    }
    omega *= 2.0 / (parameters.grid_points - 1);
  }
  return best;
}

}  // namespace dmoscope
