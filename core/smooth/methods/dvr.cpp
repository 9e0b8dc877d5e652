#include "core/smooth/methods/dvr.h"

#include <vector>

#include "core/mesh/random.h"
#include "core/search/ratio_form.h"
#include "core/smooth/line_maximum.h"
#include "core/smooth/methods/grid.h"
#include "core/smooth/methods/volume_line.h"
#include "core/smooth/visit/visit.h"

namespace dmoscope {

namespace {

constexpr double kReach = 4.0;  // in units of the star's scale, in which its other vertices are less than 2 away along each axis

LineFraction on_line(const RatioForm<double>& form, Vec2<double> d) {
  return {form.nx * d.x + form.ny * d.y, form.n0, form.s2, form.sx * d.x + form.sy * d.y, form.s0};
}

/// Calls take(form, reference measure) for every corner that the vertex's place changes. The one across a quadrilateral does not count, as
/// in volumes: where it is the worst nothing gains, and elsewhere the others still rise.
template <class Take>
void for_corners(const Star<double>& star, const Take& take) {
  for (const StarTriangle<double>& t : star.triangles) {
    RatioForm<double> form;
    triangle_form(t, form);
    take(form, t.reference * 2.0 * formulas::sqrt3);
  }
  for (const StarQuadrilateral<double>& q : star.quadrilaterals) {
    RatioForm<double> forms[kQuadrilateralForms<Metric::MeanRatio>];
    (void)quadrilateral_forms<Metric::MeanRatio>(q, forms);
    for (const RatioForm<double>& form : forms) take(form, q.reference * 2.0);
  }
}

/// Best place on the line for a planar star by the mean ratio: where it is valid, on the stretch where it stays so; else where the smallest
/// Jacobian over its reference measure is greatest. In units of the star's scale.
double best_on_line(const Star<double>& star, Vec2<double> direction) {
  thread_local std::vector<LineFraction> fractions;  // kept: a visit allocates nothing
  fractions.clear();
  bool valid = true;
  for_corners(star, [&](const RatioForm<double>& form, double /*measure*/) { valid = valid && form.n0 > 0.0; });
  double low = -kReach, high = kReach;
  for_corners(star, [&](const RatioForm<double>& form, double measure) {
    const LineFraction q = on_line(form, direction);
    if (!valid) return fractions.push_back({q.a, q.b, 0.0, 0.0, measure});
    if (q.a < 0.0) high = std::min(high, -q.b / q.a);
    if (q.a > 0.0) low = std::max(low, -q.b / q.a);
    fractions.push_back(q);
  });
  return fractions.empty() ? 0.0 : maximise_least(fractions, low, high);
}
/// Best place on the line for a volume's star. With inverted elements it is one where none is inverted; if there is no such place, where
/// DMO's measure of inversion is best.
double best_on_line(const VolumeStar<double>& star, Vec3 direction) {
  constexpr LineStretch kSpaceReach{-kReach, kReach};
  thread_local std::vector<LineCorner> corners;
  corners_on_line(star, direction, corners);
  if (least_jacobian(corners, 0.0) > 0.0 || least_jacobian(corners, best_jacobian(corners, kSpaceReach)) > 0.0)
    return best_rank(corners, kSpaceReach);
  return best_untangling(corners, kSpaceReach);
}
Vec2<double> way_on_line(double at, Vec2<double> direction, double scale) {
  const double length = at * scale;
  return {length * direction.x, length * direction.y};
}
Vec3 way_on_line(double at, Vec3 direction, double scale) { return times(times(direction, at), scale); }

/// Best place on a line through the vertex, of one direction an iteration: exactly by the mean ratio where the vertex is free, else the
/// best of as many candidates a level as where a vertex slides along a curve. On a curve that is the line.
class Line {
 public:
  static constexpr bool kSearches = true, kPlanar = false, kDependsOnIteration = true;
  Line(const SmoothingTask& task, const CompositeObjective& objective)
      : options_(task.options),
        parameters_(task.search),
        grid_(task, objective),
        exact_(objective.is_single() && objective.first == Metric::MeanRatio) {}

  [[nodiscard]] bool must_gain() const noexcept { return true; }
  void begin(const Sweep& sweep) {
    in_plane_ = dvr_direction(options_, sweep.iteration);
    in_space_ = volume_dvr_direction(options_, sweep.iteration);
  }

  template <class Places, class Frame>
  [[nodiscard]] typename Places::Coordinates choose(const Places& places, const StarScore<Frame>& score, SearchRoom<Frame>& room) const {
    if constexpr (std::is_same_v<typename Places::Coordinates, double>) {
      return grid_.choose(places, score, room);
    } else {
      const auto direction = direction_at<Frame>(places);
      if constexpr (Places::kFree)
        if (exact_) return way_on_line(best_on_line(places.star(), direction), direction, places.star().scale);
      return best_of_levels(places, score, room, direction);
    }
  }

 private:
  template <class Frame, class Places>
  [[nodiscard]] auto direction_at(const Places& places) const {
    if constexpr (std::is_same_v<Frame, Plane>)
      return in_plane_;
    else
      return places.along(in_space_);
  }
  /// Width of a box along a direction: the length of the direction's line inside it.
  static double width_along(Vec2<double> box, Vec2<double> d) { return std::min(box.x / std::abs(d.x), box.y / std::abs(d.y)); }
  static double width_along(Vec3 box, Vec3 d) { return std::min({box.x / std::abs(d.x), box.y / std::abs(d.y), box.z / std::abs(d.z)}); }

  template <class Places, class Frame>
  [[nodiscard]] typename Places::Coordinates best_of_levels(const Places& places, const StarScore<Frame>& score, SearchRoom<Frame>& room,
                                                            typename Places::Coordinates direction) const {
    auto best = places.here();
    const double full = width_along(places.box(), direction);
    if (!std::isfinite(full)) return places.way(best);
    double worth = score({}), width = score.tangled() ? 2.0 * kReach : parameters_.omega * full;  // a stray comes back from afar
    const int count = parameters_.grid_points * parameters_.grid_points;
    for (int level = 0; level < parameters_.levels; ++level) {
      const auto centre = best;
      const auto candidates = [&](const auto& take) {
        for (int i = 0; i < count; ++i) take(centre + times(direction, width * (static_cast<double>(i) / (count - 1) - 0.5)));
      };
      Grid::look(places, score, room, candidates, best, worth);
      width *= 2.0 / (count - 1);
    }
    return places.way(best);
  }

  MethodOptions options_;
  SearchParameters parameters_;
  Grid grid_;
  bool exact_;
  Vec2<double> in_plane_{};
  Vec3 in_space_{};
};

}  // namespace

Vec2<double> dvr_direction(const MethodOptions& options, std::uint64_t iteration) {
  if (options.directions == Directions::Axes) return iteration % 2 == 0 ? Vec2<double>{1, 0} : Vec2<double>{0, 1};
  Random random(Random(options.seed).next() + iteration);
  while (true) {  // draws from a ring around 0, so that no angle is more likely than another, and no library's sine is needed
    const double x = random.between(-1, 1), y = random.between(-1, 1), square = x * x + y * y;
    if (square > 0.01 && square <= 1.0) return {x / std::sqrt(square), y / std::sqrt(square)};
  }
}

Vec3 volume_dvr_direction(const MethodOptions& options, std::uint64_t iteration) {
  if (options.directions == Directions::Axes) {
    constexpr Vec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return kAxes[iteration % 3];
  }
  Random random(Random(options.seed).next() + iteration);
  while (true) {  // draws from a shell around 0, so that no direction is likelier than another
    const Vec3 p{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const double square = dot(p, p);
    if (square > 0.01 && square <= 1.0) return times(p, 1.0 / std::sqrt(square));
  }
}

std::unique_ptr<Smoother> make_dvr_smoother(const SmoothingTask& task) {
  const CompositeObjective objective = objective_of(task);
  return make_visits(task, objective, Line(task, objective));
}

}  // namespace dmoscope
