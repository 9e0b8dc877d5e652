#pragma once
// The visit of a vertex that slides along a curve of the boundary: see core/reference/curves.h.

#include <memory>
#include <optional>
#include <utility>

#include "core/reference/curves.h"
#include "core/smooth/methods/composite_dmo.h"

namespace dmoscope {

/// Searches the stretch of the curve between a vertex's neighbours, level by level, as the grid search does: grid points squared candidates
/// a level, so that it looks at as many as where a vertex is free, and each level as much finer. Of the candidates that lie between the
/// neighbours the best wins, and the vertex goes there if it gains, by the rules for all vertices (promise 1), and if neither edge of the
/// boundary then deviates from the input's curve by more than the bound, or than before. The mesh and the curves must outlive it.
class CurveSlide {
 public:
  using Scratch = Star<double>;
  /// `composite`: what the vertices aim at.
  CurveSlide(const SmoothingTask& task, CompositeObjective composite);

  [[nodiscard]] bool slides(Index vertex) const { return curves_ != nullptr && curves_->slides(vertex); }
  void begin(const Sweep& sweep);
  /// Where a vertex that slides goes.
  [[nodiscard]] std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& star) const;

 private:
  struct Stretch;
  [[nodiscard]] double search(const Stretch& stretch, const CompositeScore<Plane>& score, Vec3 here, double scale) const;
  [[nodiscard]] bool keeps_near(const Stretch& stretch, PositionView positions, double place, Vec3 target) const;

  std::shared_ptr<const Curves> curves_;  // null: nothing slides
  CompositeRule<Plane> rule_;
  Plane plane_;
  SearchParameters parameters_;
  Untangling untangling_{};
  double max_deviation_;
};

/// A rule for vertices that are free in the plane, and for those that slide.
template <class Rule>
class SlidingRule {
 public:
  using Scratch = typename Rule::Scratch;
  static constexpr bool kDependsOnStarAlone = requires { requires Rule::kDependsOnStarAlone; };
  static constexpr std::size_t kGrain = Rule::kGrain;
  SlidingRule(Rule rule, CurveSlide slide) : rule_(std::move(rule)), slide_(std::move(slide)) {}
  void begin(const Sweep& sweep) {
    rule_.begin(sweep);
    slide_.begin(sweep);
  }
  [[nodiscard]] std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& star) const {
    return slide_.slides(vertex) ? slide_.target(positions, vertex, star) : rule_.target(positions, vertex, star);
  }

 private:
  Rule rule_;
  CurveSlide slide_;
};

/// A metric as the only aim.
[[nodiscard]] CompositeObjective single_objective(Metric metric);

}  // namespace dmoscope
