#pragma once
// The visit of a vertex that slides along a curve or on a surface of the input: see core/reference/domain.h.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/reference/deviation_bound.h"
#include "core/reference/facet_walk.h"
#include "core/smooth/methods/composite_dmo.h"

namespace dmoscope {

/// How a method chooses among the places to which a vertex may slide.
struct SlideChoice {
  enum class By : std::uint8_t {
    Grid,    // the best of a grid, level by level
    Mean,    // of the neighbours: on a curve of the two, on a surface of those that share an edge of it
    Compass  // see compass_search
  };
  By by = By::Grid;
  double relaxation = 1.0;  // Mean: the share of the way that is gone
  bool must_gain = true;    // else it goes wherever the surface lets it, whatever becomes of the elements
};

/// On a curve: searches the stretch between a vertex's neighbours, level by level, as the grid search does: grid points squared candidates
/// a level, so that it looks at as many as where a vertex is free, and each level as much finer. Of the candidates that lie between the
/// neighbours the best wins.
/// On a surface: the very grid search in the tangent plane, each candidate taken straight down to the facet beneath it; those beyond a
/// feature edge, and where the surface turns away, do not count. Of a curved surface the search is in the plane, with the star's elements
/// as they look from above, by packs of candidates; only where its winner may not stay, the other is done. The vertex goes to the winner if
/// it gains there, by the rules for all vertices (promise 1), and if no edge of a curve and no face of the surface then deviates from the
/// input by more than the bound, or leans more than 60 degrees away from it, or than before. In space it tries half of the way where it may
/// not go all of it, and half of that, twice more. The mesh must outlive it. Frame: Plane, where all slide along curves, Space, or Curved.
template <class Frame>
class Slide {
 public:
  struct Scratch {
    JudgedStar<Frame> star;
    Star<double> flat;  // of a curved surface: the star in the tangent plane
    CandidateList candidates;
    std::vector<double> places;       // of the candidates on a curve
    std::vector<Vec2<double>> steps;  // of those on a surface, in the tangent plane
    FacetWalks::Room walks;
    OverlayRoom room;
  };
  /// `composite`: what the vertices aim at.
  Slide(const SmoothingTask& task, CompositeObjective composite, SlideChoice choice = {});

  [[nodiscard]] bool slides(Index vertex) const { return domain_ != nullptr && domain_->slides(vertex); }
  void begin(const Sweep& sweep);
  /// Where a vertex that slides goes.
  [[nodiscard]] std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const;

 private:
  using Offset = OffsetIn<Frame, double>;
  struct Visit;
  struct Stretch;
  [[nodiscard]] std::optional<Vec3> along_curve(const Visit& visit) const;
  struct Tangent;
  [[nodiscard]] std::optional<Vec3> on_surface(const Visit& visit) const;
  [[nodiscard]] std::optional<FacetPlace> place_on_surface(const Visit& visit) const;
  [[nodiscard]] std::optional<Vec2<double>> search_flat(const Visit& visit, const Tangent& tangent) const;
  [[nodiscard]] Vec2<double> search_on_surface(const Visit& visit, const Tangent& tangent) const;
  [[nodiscard]] Vec2<double> search_grid(const Visit& visit, const Tangent& tangent, const FacetWalks& walks) const;
  [[nodiscard]] std::size_t first_best(const Visit& visit, double& best) const;
  template <class F>
  void for_neighbours_on_surface(const Visit& visit, const F& f) const;
  [[nodiscard]] Vec2<double> step_to_mean(const Visit& visit, const Tangent& tangent) const;
  [[nodiscard]] std::optional<Vec3> possible_on_surface(const Visit& visit, const Tangent& tangent, Vec2<double> step) const;
  [[nodiscard]] Offset offset_to(const Visit& visit, Vec3 there) const;
  [[nodiscard]] double search(const Visit& visit, const Stretch& stretch) const;
  [[nodiscard]] double search_grid(const Visit& visit, const Stretch& stretch) const;
  [[nodiscard]] std::optional<Vec3> possible(const Visit& visit, const Stretch& stretch, double place) const;
  [[nodiscard]] bool may_go(const Visit& visit, Vec3 target) const;
  [[nodiscard]] bool keeps_near(const Visit& visit, const Stretch& stretch, double place, Vec3 target) const;
  [[nodiscard]] bool fits(const Visit& visit, Vec3 target, const FacetPlace* here, const FacetPlace* there) const;

  std::shared_ptr<const Domain> domain_;  // null: nothing slides
  StarJudge<Frame> judge_;
  MeshView<Frame> mesh_;
  CompositeKernel<Plane> flat_kernel_ = nullptr;      // of a curved surface
  CompositeListKernel<Frame> list_kernel_ = nullptr;  // null: the plain search alone
  CompositeSearch<Plane> flat_aims_;                  // for the kernels
  CompositeSearch<Frame> aims_;
  SearchParameters parameters_;
  SlideChoice choice_;
  std::optional<DeviationBound> bound_;  // none: nothing slides
  bool single_precision_;
  /// Where a vertex was last found on the surface. A place follows from the position, so no result depends on it; one visit at a time looks
  /// at it.
  struct Found {
    Vec3 position{};
    FacetPlace place{};  // facet: from where on to look for another position; kNoIndex: not found yet
    bool valid = false;  // of the position
  };
  mutable std::vector<Found> found_;  // by vertex
};

/// A rule for vertices that are free, and for those that slide.
template <class Rule, class Frame>
class SlidingRule {
 public:
  struct Scratch {
    typename Rule::Scratch free;
    typename Slide<Frame>::Scratch slide;
  };
  static constexpr std::size_t kGrain = std::min<std::size_t>(grain_of<Rule>(), 32);
  SlidingRule(Rule rule, Slide<Frame> slide) : rule_(std::move(rule)), slide_(std::move(slide)) {}
  void begin(const Sweep& sweep) {
    if constexpr (requires { rule_.begin(sweep); }) rule_.begin(sweep);
    slide_.begin(sweep);
  }
  [[nodiscard]] std::span<const Index> others(Index vertex) const requires requires(const Rule& rule) { rule.others(vertex); }
  { return rule_.others(vertex); }
  [[nodiscard]] std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    return slide_.slides(vertex) ? slide_.target(positions, vertex, scratch.slide) : rule_.target(positions, vertex, scratch.free);
  }

 private:
  Rule rule_;
  Slide<Frame> slide_;
};

/// A smoother by a rule for vertices that are free, and by a choice for those that slide.
template <class Frame, class Rule>
[[nodiscard]] std::unique_ptr<Smoother> make_sliding_smoother(const SmoothingTask& task, Rule rule, CompositeObjective composite,
                                                              SlideChoice choice = {}) {
  if (!task.domain) return make_rule_smoother(task, std::move(rule));
  return make_rule_smoother(task, SlidingRule<Rule, Frame>(std::move(rule), Slide<Frame>(task, std::move(composite), choice)));
}

/// A smoother of a curved surface, where all that moves slides.
[[nodiscard]] std::unique_ptr<Smoother> make_surface_smoother(const SmoothingTask& task, CompositeObjective composite,
                                                              SlideChoice choice = {});

/// A metric as the only aim.
[[nodiscard]] CompositeObjective single_objective(Metric metric);

}  // namespace dmoscope
