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
    double omega = parameters_.omega;
    for (int level = 0; level < parameters_.levels; ++level) {
      const auto candidates = [&](const auto& take) { places.for_grid(best, omega, parameters_.grid_points, take); };
      look(places, score, room, candidates, best, worth);
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
  SearchParameters parameters_;
  CompositeKernel<Plane> flat_kernel_ = nullptr;  // kernel for curved surfaces
  CompositeSearch<Plane> flat_aims_;
};

}  // namespace dmoscope
