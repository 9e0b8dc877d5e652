#include "core/smooth/methods/dvr.h"

#include <vector>

#include "core/mesh/random.h"
#include "core/search/ratio_form.h"
#include "core/smooth/line_maximum.h"
#include "core/smooth/methods/volume_dvr.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

constexpr double kReach = 4.0;  // in units of the star's scale, in which its other vertices are less than 2 away along each axis

/// A star on a line through its vertex.
struct StarOnLine {
  Star<double> star;
  std::vector<LineFraction> fractions;
};

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

class Dvr {
 public:
  using Scratch = StarOnLine;
  static constexpr bool kDependsOnIteration = true;
  explicit Dvr(const SmoothingTask& task) : mesh_(*task.input), options_(task.options) {}

  void begin(const Sweep& sweep) {
    direction_ = dvr_direction(options_, sweep.iteration);
    mesh_.untangling = sweep.untangling;
  }

  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), scratch.star);
    const bool valid = is_valid(scratch.star);
    const double t = valid ? best_quality(scratch) : best_jacobian(scratch);
    if (t == 0.0) return std::nullopt;
    const double length = t * scratch.star.scale;
    return mesh_.moved_if_gaining<Metric::MeanRatio>(positions, vertex, {length * direction_.x, length * direction_.y});
  }

 private:
  static bool is_valid(const Star<double>& star) {
    bool valid = true;
    for_corners(star, [&](const RatioForm<double>& form, double /*measure*/) { valid = valid && form.n0 > 0.0; });
    return valid;
  }

  /// The best place for a valid star, on the stretch of the line where it stays valid.
  double best_quality(Scratch& scratch) const {
    scratch.fractions.clear();
    double low = -kReach, high = kReach;
    for_corners(scratch.star, [&](const RatioForm<double>& form, double /*measure*/) {
      const LineFraction q = on_line(form, direction_);
      if (q.a < 0.0) high = std::min(high, -q.b / q.a);
      if (q.a > 0.0) low = std::max(low, -q.b / q.a);
      scratch.fractions.push_back(q);
    });
    return scratch.fractions.empty() ? 0.0 : maximise_least(scratch.fractions, low, high);
  }

  /// The best place for a star with inverted elements: where the smallest Jacobian over its reference measure is greatest.
  double best_jacobian(Scratch& scratch) const {
    scratch.fractions.clear();
    for_corners(scratch.star, [&](const RatioForm<double>& form, double measure) {
      const LineFraction q = on_line(form, direction_);
      scratch.fractions.push_back({q.a, q.b, 0.0, 0.0, measure});
    });
    return scratch.fractions.empty() ? 0.0 : maximise_least(scratch.fractions, -kReach, kReach);
  }

  RuleMesh<Plane> mesh_;
  MethodOptions options_;
  Vec2<double> direction_;
};

}  // namespace

Vec2<double> dvr_direction(const MethodOptions& options, std::uint64_t iteration) {
  if (options.directions == Directions::Axes) return iteration % 2 == 0 ? Vec2<double>{1, 0} : Vec2<double>{0, 1};
  Random random(Random(options.seed).next() + iteration);
  while (true) {  // from a ring around 0, so that no angle is more likely than another, and no library's sine is needed
    const double x = random.between(-1, 1), y = random.between(-1, 1), square = x * x + y * y;
    if (square > 0.01 && square <= 1.0) return {x / std::sqrt(square), y / std::sqrt(square)};
  }
}

std::unique_ptr<Smoother> make_dvr_smoother(const SmoothingTask& task) {
  return task.input->is_volume() ? make_volume_dvr_smoother(task) : make_rule_smoother(task, Dvr(task));
}

}  // namespace dmoscope
