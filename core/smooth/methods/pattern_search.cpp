// Compass search (the pattern search that Park and Shontz 2010 use on meshes): four steps along the axes are tried, the best is made, and
// the steps grow or shrink, until they are small.

#include "core/search/compass_search.h"
#include "core/smooth/visit/visit.h"

namespace dmoscope {

namespace {

/// Choice of a place by compass_search().
class Compass {
 public:
  static constexpr bool kSearches = true, kPlanar = false, kDependsOnIteration = false;
  [[nodiscard]] bool must_gain() const noexcept { return true; }

  template <class Places, class Frame>
  [[nodiscard]] typename Places::Coordinates choose(const Places& places, const StarScore<Frame>& score,
                                                    SearchRoom<Frame>& /*room*/) const {
    using Coordinates = typename Places::Coordinates;
    const bool shifts = Places::kFree && !score.positive_where_sound() && !score.tangled();  // not where vertices slide: ties differ
    const auto worth = [&](Coordinates by) {
      const auto offset = by == Coordinates{} ? OffsetIn<Frame, double>{} : places.offset(places.shifted(by));
      if (!offset) return StarScore<Frame>::kAll;
      const double value = score(*offset);
      return shifts ? positive(value) : value;
    };
    return places.way(places.shifted(compass_search<Coordinates>(worth, places.edge())));
  }

 private:
  /// Maps the score of a sound star, which a formula may put below 0, to a rising function above 0.
  static double positive(double value) {
    if (value <= DefinedStar<Plane>::kInverted) return 0.0;
    return value > 0.0 ? 1.0 + value : 1.0 / (1.0 - value);
  }
};

}  // namespace

std::unique_ptr<Smoother> make_pattern_search_smoother(const SmoothingTask& task) {
  return make_visits(task, objective_of(task), Compass{});
}

}  // namespace dmoscope
