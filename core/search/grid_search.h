#pragma once
// The DMO grid search (paper, Algorithm 2), once: a template over its metric and its lane. A lane is one vertex; its scalar `Real`
// is double (the reference) or float (for speed), and may be a pack that holds several vertices.

#include <limits>

#include "core/quality/formulas.h"
#include "core/search/parameters.h"
#include "core/search/star.h"

namespace dmoscope {

/// What is maximised at a candidate position.
/// A star without inverted elements: the least metric (paper eq. 1); a candidate that inverts one is <= 0 and never wins.
/// Otherwise (Untangling): the smallest corner Jacobian over its element's reference measure while it is <= 0, and the least metric
/// once all are positive; every valid candidate is above every invalid one, since valid elements have positive metrics.
template <Metric M, bool Untangling, class Real>
class Objective {
 public:
  explicit Objective(const Star<Real>& star) : star_(star) {}

  [[nodiscard]] Real operator()(Vec2<Real> p) const {
    Real quality = scalar::constant<Real>(std::numeric_limits<float>::max());
    Real jacobian = scalar::constant<Real>(std::numeric_limits<float>::max());
    for (const auto& t : star_.triangles) {
      const formulas::Triangle<Vec2<Real>> triangle(p, t.b, t.c);
      quality = scalar::min(quality, formulas::Formula<M>::triangle(triangle));
      if constexpr (kNeedsJacobian) jacobian = scalar::min(jacobian, formulas::smallest_jacobian(triangle) / t.reference);
    }
    if constexpr (kQuadrilaterals) {
      for (const auto& q : star_.quadrilaterals) {
        const formulas::Quadrilateral<Vec2<Real>> quadrilateral(p, q.b, q.c, q.d);
        quality = scalar::min(quality, formulas::Formula<M>::quadrilateral(quadrilateral));
        if constexpr (kNeedsJacobian) jacobian = scalar::min(jacobian, formulas::smallest_jacobian(quadrilateral) / q.reference);
      }
    }
    if constexpr (kNeedsJacobian) return scalar::select(jacobian > Real(0), quality, jacobian);
    return quality;
  }

 private:
  static constexpr bool kQuadrilaterals = formulas::kDefinedForQuadrilaterals<M, Vec2<Real>>;
  static constexpr bool kNeedsJacobian = Untangling || !formulas::Formula<M>::kSeesInversion;
  const Star<Real>& star_;
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
        best.objective = scalar::select(better, value, best.objective);
        best.offset = {scalar::select(better, p.x, best.offset.x), scalar::select(better, p.y, best.offset.y)};
      }
    }
    omega *= 2.0 / (parameters.grid_points - 1);
  }
  return best;
}

}  // namespace dmoscope
