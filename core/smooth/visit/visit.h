#pragma once
// Visit of one vertex: its possible places, the choice of one by an objective, and whether it gains there. Every method is a way of
// choosing; every objective, every frame and every kind of place works with it.

#include <memory>
#include <optional>
#include <utility>

#include "core/smooth/visit/curve_places.h"
#include "core/smooth/visit/free_places.h"
#include "core/smooth/visit/star_kernel.h"
#include "core/smooth/visit/surface_places.h"

namespace dmoscope {

/// A rule for RuleSmoother. The mesh must outlive it. Method has
/// - choose(places, score, room): the way to the place that it chooses, in the units of the places' ways, if kSearches; else
///   choose(places);
/// - kSearches: whether it asks the objective where to go; kPlanar: whether it excludes volumes; kDependsOnIteration: see VertexRule;
/// - must_gain(): else a vertex goes wherever it may, even if elements become worse;
/// - begin(sweep); from_above(places, star), a search that goes before choose() where no element is inverted: only if it needs them.
template <class Frame, class Method>
class Visit {
 public:
  struct Scratch {
    JudgedStar<Frame> star;
    SearchRoom<Frame> room;
  };
  static constexpr bool kDependsOnIteration = Method::kDependsOnIteration;
  static constexpr std::size_t kGrain = !Method::kSearches ? 128 : std::is_same_v<Frame, Space> ? 8 : 32;  // in space a visit may be long

  /// `kernel`: search of free vertices; null: the plain search alone.
  Visit(const SmoothingTask& task, CompositeObjective objective, Method method, std::shared_ptr<const StarKernel<Frame>> kernel = {})
      : judge_(*task.input, std::move(objective), task.search.simd.value_or(best_simd_level()), task.domain),
        mesh_(*task.input),
        domain_(task),
        method_(std::move(method)),
        search_(task.search),
        kernel_(std::move(kernel)),
        has_inside_(task.input->is_volume() && std::ranges::any_of(task.input->mesh.elements.kinds(), &has_inside)) {}

  void begin(const Sweep& sweep) {
    judge_.begin(sweep);
    if constexpr (requires { method_.begin(sweep); }) method_.begin(sweep);
  }
  [[nodiscard]] std::span<const Index> others(Index vertex) const { return kernel_ ? kernel_->others(vertex) : std::span<const Index>(); }
  [[nodiscard]] bool slides(Index vertex) const { return domain_.slides(vertex); }
  [[nodiscard]] const std::optional<Guard>& guard() const noexcept { return judge_.composite().guard; }
  /// Place of a free vertex for which a kernel has found a target: another one where the guard does not let it go there.
  [[nodiscard]] std::optional<Vec3> confirmed(Index vertex, Vec3 target, PositionView positions, Scratch& scratch) const {
    bool breaks_guard = false;
    if (confirmation(positions, vertex, scratch, &breaks_guard)(target) == Confirmation::Gains) return target;
    if constexpr (!std::is_same_v<Frame, Curved>)
      if (breaks_guard) return search_guarded(FreePlaces<Frame>(mesh_, positions, vertex, scratch.star), positions, vertex, scratch);
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    if (domain_.slides(vertex)) return slide(positions, vertex, scratch);
    if constexpr (std::is_same_v<Frame, Curved>)
      return std::nullopt;
    else
      return move(positions, vertex, scratch);
  }

 private:
  [[nodiscard]] bool waits(bool tangled) const { return judge_.untangling().repair && method_.must_gain() && !tangled; }

  /// Chooses a way among places. `guarded`: see StarScore.
  template <class Places>
  [[nodiscard]] auto choose(const Places& places, PositionView positions, Index vertex, bool tangled, bool guarded,
                            Scratch& scratch) const {
    if constexpr (Method::kSearches)
      return method_.choose(places, judge_.score_of(scratch.star, positions, vertex, tangled, guarded), scratch.room);
    else
      return method_.choose(places);
  }
  /// Function that tells whether the statistics' formulas let the vertex go to a place. `breaks_guard`: becomes true where the guard alone
  /// does not; null: a place nearer to its present one may do then.
  [[nodiscard]] auto confirmation(PositionView positions, Index vertex, const Scratch& scratch, bool* breaks_guard,
                                  const StarState* before = nullptr) const {
    return [this, positions, vertex, watcher = scratch.room.watcher, breaks_guard, before](Vec3 target) {
      if (!method_.must_gain()) return Confirmation::Gains;
      Confirmation found = judge_.confirm(positions, vertex, target, before);
      if (found == Confirmation::Gains && !judge_.keeps_guard(positions, vertex, target)) {
        found = breaks_guard != nullptr ? Confirmation::GainsNothing : Confirmation::TooFar;
        if (breaks_guard != nullptr) *breaks_guard = true;
      }
      if (watcher != nullptr) watcher->judged(found);
      return found;
    };
  }
  /// Goes to the place that the method chooses or, where the guard forbids that, to the one that it chooses among places that the guard
  /// allows.
  template <class Places>
  [[nodiscard]] std::optional<Vec3> go(const Places& places, PositionView positions, Index vertex, bool tangled, Scratch& scratch) const {
    bool breaks_guard = false;
    const auto target =
        places.go(choose(places, positions, vertex, tangled, false, scratch), confirmation(positions, vertex, scratch, &breaks_guard));
    return breaks_guard ? go_guarded(places, positions, vertex, tangled, scratch) : target;
  }
  template <class Places>
  [[nodiscard]] std::optional<Vec3> go_guarded(const Places& places, PositionView positions, Index vertex, bool tangled,
                                               Scratch& scratch) const {
    return places.go(choose(places, positions, vertex, tangled, true, scratch), confirmation(positions, vertex, scratch, nullptr));
  }

  [[nodiscard]] std::optional<Vec3> slide(PositionView positions, Index vertex, Scratch& scratch) const {
    judge_.gather(positions, vertex, scratch.star);
    const bool tangled = judge_.is_tangled(scratch.star);
    const bool waits = this->waits(tangled);
    if (waits && scratch.room.watcher == nullptr) return std::nullopt;
    const auto go = [&](const auto& places) -> std::optional<Vec3> {
      if (!places) return std::nullopt;
      // Tells of the search itself, whether or not one from above goes before it.
      if (scratch.room.watcher != nullptr) (void)choose(*places, positions, vertex, tangled, false, scratch);
      scratch.room.watcher = nullptr;
      if (waits) return std::nullopt;
      if constexpr (requires { method_.from_above(*places, scratch.star); }) {
        if (!tangled) {
          if (const auto way = method_.from_above(*places, scratch.star)) {
            if (*way == Vec2<double>{}) return std::nullopt;
            bool breaks_guard = false;
            if (const auto target = places->go(*way, confirmation(positions, vertex, scratch, &breaks_guard))) return target;
          }
        }
      }
      return this->go(*places, positions, vertex, tangled, scratch);
    };
    if (domain_.on_curve(vertex))
      return go(CurvePlaces<Frame>::of(domain_, judge_.mesh(), positions, vertex, scratch.star.scale, scratch.room));
    if constexpr (std::is_same_v<Frame, Plane>)
      return std::nullopt;
    else
      return go(SurfacePlaces<Frame>::of(domain_, judge_.mesh(), positions, vertex, scratch.star.scale, scratch.room));
  }

  /// Moves a free vertex.
  [[nodiscard]] std::optional<Vec3> move(PositionView positions, Index vertex, Scratch& scratch) const {
    const FreePlaces<Frame> places(mesh_, positions, vertex, scratch.star);
    if (kernel_ && !judge_.untangling().repair) {
      const auto found = kernel_->find(positions, vertex, judge_.untangling(), search_.levels);
      if (found.ready && scratch.room.watcher != nullptr) tell_kernel(found, positions, vertex, scratch);
      if (found.ready) return move_to(places, found, positions, vertex, scratch);
    }
    return search(places, positions, vertex, scratch);
  }
  /// Tells the watcher of the search of a kernel, which has found the best place of the star.
  void tell_kernel(const typename StarKernel<Frame>::Found& star, PositionView positions, Index vertex, Scratch& scratch) const {
    judge_.gather(positions, vertex, scratch.star);
    const auto score = judge_.score_of(scratch.star, positions, vertex, false);
    const auto find = [&](int levels) { return kernel_->find(positions, vertex, judge_.untangling(), levels).offset; };
    const auto tell = star.single ? tell_levels<float, OffsetIn<Frame, double>, decltype(score), decltype(find)>
                                  : tell_levels<double, OffsetIn<Frame, double>, decltype(score), decltype(find)>;
    tell(*scratch.room.watcher, search_, star.scale, star.box, score, find);
  }
  /// Searches again with the guard, of which the first search did not know.
  [[nodiscard]] std::optional<Vec3> search_guarded(const FreePlaces<Frame>& places, PositionView positions, Index vertex,
                                                   Scratch& scratch) const {
    if constexpr (Method::kSearches) judge_.gather(positions, vertex, scratch.star);
    return go_guarded(places, positions, vertex, false, scratch);
  }
  [[nodiscard]] std::optional<Vec3> search(const FreePlaces<Frame>& places, PositionView positions, Index vertex, Scratch& scratch) const {
    bool tangled = false;
    if constexpr (Method::kSearches) {
      judge_.gather(positions, vertex, scratch.star);
      tangled = judge_.is_tangled(scratch.star);
      if (waits(tangled)) return std::nullopt;
    }
    return go(places, positions, vertex, tangled, scratch);
  }
  [[nodiscard]] std::optional<Vec3> move_to(const FreePlaces<Frame>& places, const typename StarKernel<Frame>::Found& found,
                                            PositionView positions, Index vertex, Scratch& scratch) const {
    if (found.offset == OffsetIn<Frame, double>{}) return std::nullopt;
    const auto way = times(found.offset, found.scale);
    const auto target = mesh_.moved(positions[vertex], way);
    if (!target) return std::nullopt;
    const std::optional<bool> known = kernel_->gains(positions, vertex, *target);
    if (known && !*known) return std::nullopt;
    if (known && (!has_inside_ || kernel_->valid_at(vertex, *target) || keeps_sound(mesh_.view, positions, vertex, *target)) &&
        ((guard() && kernel_->keeps(*guard(), vertex, *target)) || judge_.keeps_guard(positions, vertex, *target)))
      return target;
    bool breaks_guard = false;
    const auto confirm = confirmation(positions, vertex, scratch, &breaks_guard, found.before ? &*found.before : nullptr);
    const auto confirmed = places.go(way, confirm);
    return breaks_guard ? search_guarded(places, positions, vertex, scratch) : confirmed;
  }

  /// Replaces the mesh of free vertices on curved surfaces, which have none.
  struct NoMesh {
    explicit NoMesh(const InputMesh& /*input*/) {}
  };

  StarJudge<Frame> judge_;
  std::conditional_t<std::is_same_v<Frame, Curved>, NoMesh, RuleMesh<Frame>> mesh_;
  SlidingDomain domain_;
  Method method_;
  SearchParameters search_;
  std::shared_ptr<const StarKernel<Frame>> kernel_;
  bool has_inside_;
};

/// Makes the smoother of a method, with any objective, in the frame of the task's mesh.
template <class Method>
[[nodiscard]] std::unique_ptr<Smoother> make_visits(const SmoothingTask& task, const CompositeObjective& objective, const Method& method) {
  const auto visits = [&]<class Frame>() -> std::unique_ptr<Smoother> {
    return make_rule_smoother(task, Visit<Frame, Method>(task, objective, method));
  };
  if (task.input->is_surface()) return visits.template operator()<Curved>();
  if constexpr (!Method::kPlanar)
    if (task.input->is_volume()) return visits.template operator()<Space>();
  return visits.template operator()<Plane>();
}

}  // namespace dmoscope
