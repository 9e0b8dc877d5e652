#pragma once
// Grid search of DMO (paper, Algorithm 1): the best candidate of a grid, level by level, each finer than the one before.

#include <optional>

#include "core/smooth/visit/surface_places.h"

namespace dmoscope {

class Grid {
 public:
  static constexpr bool kSearches = true, kPlanar = false, kDependsOnIteration = false;
  /// `objective`: that of the visits, for kernels.
  Grid(const SmoothingTask& task, const CompositeObjective& objective);

  [[nodiscard]] bool must_gain() const noexcept { return true; }

  /// Finds the first of the best candidates of all levels; the vertex's own place if none is better. Grids after the first are centred on
  /// the best place so far.
  template <class Places, class Frame>
  [[nodiscard]] typename Places::Coordinates choose(const Places& places, const StarScore<Frame>& score, SearchRoom<Frame>& room) const {
    auto best = places.here();
    double worth = score({});
    if (score.tangled()) {
      const auto middle = places.middle();
      const auto offset = middle ? places.offset(*middle) : std::nullopt;
      if (offset)
        if (const double there = score(*offset); there > worth) worth = there, best = *middle;
    }
    if (room.watcher != nullptr) room.watcher->begin({score({}), in_space(places.way(best)), worth, score.tangled()});
    double omega = parameters_.omega;
    for (int level = 0; level < parameters_.levels; ++level) {
      const auto centre = best;
      const auto candidates = [&](const auto& take) { places.for_grid(centre, omega, parameters_.grid_points, take); };
      look(places, score, room, candidates, best, worth);
      if (room.watcher != nullptr) tell_level(places, score, centre, omega, best, *room.watcher);
      omega *= 2.0 / (Places::candidates_per_axis(parameters_.grid_points) - 1);
    }
    return places.way(best);
  }

  /// Makes the first of the best candidates the `best` place where its score is greater. candidates(take): calls take(coordinates) for
  /// each.
  template <class Places, class Frame, class Candidates>
  static void look(const Places& places, const StarScore<Frame>& score, SearchRoom<Frame>& room, const Candidates& candidates,
                   typename Places::Coordinates& best, double& worth) {
    auto& coordinates = room.template list<typename Places::Coordinates>();
    room.candidates.clear(), coordinates.clear();
    candidates([&](const typename Places::Coordinates& at) {
      const auto offset = places.offset(at);
      if (!offset) return;
      room.candidates.add(*offset);
      coordinates.push_back(at);
    });
    if (const std::size_t found = score.first_best(room.candidates, worth); found < coordinates.size()) best = coordinates[found];
  }

  /// Way to the winner in the tangent plane, for a sound star's elements as they look from above: found by packs of candidates; none where
  /// the kernel does not take the star.
  [[nodiscard]] std::optional<Vec2<double>> from_above(const SurfacePlaces<Curved>& places, const SurfaceStar& star) const;

 private:
  /// Tells a watcher of a level, with the scores of its candidates; not on a curve, where they lie on a line.
  template <class Places, class Frame>
  void tell_level(const Places& places, const StarScore<Frame>& score, typename Places::Coordinates centre, double omega,
                  typename Places::Coordinates best, VisitWatcher& watcher) const {
    if constexpr (!std::is_same_v<typename Places::Coordinates, double>) {
      watcher.level(in_space(places.way(centre)), in_space(places.way(times(places.box(), omega))), parameters_.grid_points);
      places.for_grid(centre, omega, parameters_.grid_points, [&](const auto& at) {
        const auto offset = places.offset(at);
        watcher.candidate(in_space(places.way(at)), offset ? score(*offset) : StarScore<Frame>::kAll);
      });
      watcher.found(in_space(places.way(best)));
    }
  }

  SearchParameters parameters_;
  CompositeKernel<Plane> flat_kernel_ = nullptr;  // kernel for curved surfaces
  CompositeSearch<Plane> flat_aims_;
};

}  // namespace dmoscope
