#include "core/smooth/methods/active_set_ascent.h"

#include <limits>
#include <vector>

#include "core/numeric/dual.h"
#include "core/smooth/defined_pieces.h"
#include "core/smooth/methods/defined_rule.h"
#include "core/smooth/star_pieces.h"

namespace dmoscope {

namespace {

// Lengths are in units of the star's scale, in which its other vertices are about 1 away.
constexpr double kActive = 3e-5;  // above the least
constexpr double kLeastStep = 1e-6, kLeastGain = 1e-6, kLongestStep = 1.0;
constexpr double kNearEstimate = 0.9;
constexpr int kSteps = 20;

/// What one of the functions is at a place, and how it rises there. V: Vec2<double> or Vec3.
template <class V>
struct Piece {
  double value;
  V gradient;
};

/// Frame: Plane or Space.
template <class Frame>
struct AscentScratch {
  using V = OffsetIn<Frame, double>;
  std::vector<Piece<V>> pieces;
  std::vector<V> active;  // gradients
};

double norm(Vec2<double> a) { return std::hypot(a.x, a.y); }
double norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// The point of the segment from a to b that is nearest to 0.
template <class V>
V nearest_to_zero(V a, V b) {
  const V way = b - a;
  const double square = dot(way, way);
  if (!(square > 0.0)) return a;
  return a + times(way, std::clamp(-dot(a, way) / square, 0.0, 1.0));
}

/// The foot of 0 on the plane of three points, where it lies in their triangle.
std::optional<Vec3> foot_of_zero(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c, n = cross(ab, bc);
  const double square = dot(n, n);
  if (!(square > 1e-24 * dot(ab, ab) * dot(bc, bc))) return std::nullopt;  // next to a segment
  const Vec3 foot = times(n, dot(n, a) / square);
  const auto inside = [&](Vec3 from, Vec3 edge) { return dot(cross(edge, foot - from), n) >= 0.0; };
  return inside(a, ab) && inside(b, bc) && inside(c, ca) ? std::optional(foot) : std::nullopt;
}

/// Looks for what is nearer to 0 than `best` inside the hull's faces: in a plane it has none but its edges.
void look_at_faces(const std::vector<Vec2<double>>& /*gradients*/, Vec2<double>& /*best*/) {}
void look_at_faces(const std::vector<Vec3>& gradients, Vec3& best) {
  const std::size_t n = gradients.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k)
      for (std::size_t l = k + 1; l < n; ++l)
        if (const auto foot = foot_of_zero(gradients[i], gradients[k], gradients[l]); foot && dot(*foot, *foot) < dot(best, best))
          best = *foot;
}

/// The point of the gradients' convex hull that is nearest to 0: along it all of them rise, by its length at least. 0 where they cannot.
template <class V>
V steepest(const std::vector<V>& gradients) {
  V best = gradients.front();
  for (std::size_t i = 0; i < gradients.size(); ++i)
    for (std::size_t k = i; k < gradients.size(); ++k) {
      const V p = nearest_to_zero(gradients[i], gradients[k]);
      if (dot(p, p) < dot(best, best)) best = p;
    }
  look_at_faces(gradients, best);
  // The hull's edges and faces are among these, so that one that lies on the wrong side of none of the gradients is its nearest.
  constexpr double kRounding = 1e-9;
  for (const V g : gradients)
    if (dot(g, best) < (1.0 - kRounding) * dot(best, best)) return {};
  return best;
}

/// Raises the least of the pieces from a place. for_pieces(p, f): calls f with each piece's value with the star's vertex at p, in the
/// scalar of p. worth(p): the least of them, or what else the place is worth.
template <class Frame, class ForPieces, class Worth>
class Ascent {
 public:
  using V = OffsetIn<Frame, double>;
  Ascent(AscentScratch<Frame>& scratch, const ForPieces& for_pieces, const Worth& worth)
      : scratch_(scratch), for_pieces_(for_pieces), worth_(worth) {}

  [[nodiscard]] V from(V place) const {
    double worth = worth_(place);
    for (int round = 0; round < kSteps; ++round) {
      const double least = look_at(place);
      if (scratch_.active.empty()) break;  // nothing here has a value
      const V direction = steepest(scratch_.active);
      const double rate = norm(direction);
      if (!(rate > 0.0)) break;  // an equilibrium
      const V unit = times(direction, 1.0 / rate);
      V next = place;
      const double gain = search(place, worth, unit, rate, next_activation(least, unit, rate), next);
      place = next;
      worth += gain;
      if (gain < kLeastGain) break;
    }
    return place;
  }

 private:
  /// Gathers the pieces and those that are active; returns the least.
  double look_at(V place) const {
    scratch_.pieces.clear();
    scratch_.active.clear();
    double least = std::numeric_limits<double>::infinity();
    for_pieces_(variable(place), [&](const auto& q) {
      least = std::min(least, q.value);
      scratch_.pieces.push_back({q.value, q.by});
    });
    for (const Piece<V>& piece : scratch_.pieces) {
      // The corner across a quadrilateral never changes: one that is only near the least bounds the gain, but is no reason to stay.
      const bool constant = piece.gradient == V{};
      if (piece.value <= least + (constant ? 0.0 : kActive)) scratch_.active.push_back(piece.gradient);
    }
    return least;
  }

  /// How far until another piece would be as low as the active ones, if all were linear.
  [[nodiscard]] double next_activation(double least, V unit, double rate) const {
    double nearest = kLongestStep;
    for (const Piece<V>& piece : scratch_.pieces) {
      const double slower = rate - dot(piece.gradient, unit);
      if (piece.value > least + kActive && slower > 0.0) nearest = std::min(nearest, (piece.value - least) / slower);
    }
    return nearest;
  }

  /// Halves the step until it gains about what it should, or the last longer one gained more. Returns the gain of the best, at `next`.
  double search(V place, double worth, V unit, double rate, double step, V& next) const {
    double best = 0.0;
    for (; step > kLeastStep; step *= 0.5) {
      const V there = place + times(unit, step);
      const double gain = worth_(there) - worth;
      if (best > 0.0 && !(gain > best)) break;
      if (gain > best) best = gain, next = there;
      if (gain >= kNearEstimate * rate * step) break;
    }
    return best;
  }

  AscentScratch<Frame>& scratch_;
  const ForPieces& for_pieces_;
  const Worth& worth_;
};

/// Raises the least quality; where an element is inverted the least Jacobian first, by as much as turns it. worth(p): of a sound star.
template <class Frame, class Star, class Qualities, class Worth>
OffsetIn<Frame, double> ascend(AscentScratch<Frame>& scratch, const Star& star, const Qualities& qualities, const Worth& worth) {
  using V = OffsetIn<Frame, double>;
  const auto jacobians = [&star](auto p, const auto& f) { for_jacobians(star, p, f); };
  const auto least_jacobian = [&star](V p) {
    double least = std::numeric_limits<double>::infinity();
    for_jacobians(star, p, [&least](double j) { least = std::min(least, j); });
    return least;
  };
  V place{};
  if (!(least_jacobian(place) > 0.0))
    place = Ascent<Frame, decltype(jacobians), decltype(least_jacobian)>(scratch, jacobians, least_jacobian).from(place);
  if (!(least_jacobian(place) > 0.0)) return place;
  return Ascent<Frame, Qualities, Worth>(scratch, qualities, worth).from(place);
}

template <Metric M, class Frame>
class ActiveSet {
 public:
  struct Scratch {
    StarIn<Frame, double> star;
    AscentScratch<Frame> ascent;
  };
  explicit ActiveSet(const SmoothingTask& task) : mesh_(*task.input) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    const auto& star = scratch.star;
    gather_star(MeshStar(mesh_.view, positions, vertex), scratch.star);
    using View = StarViewIn<Frame, double>;
    const auto qualities = [&star](auto p, const auto& f) { for_qualities<M>(star, p, f); };
    const auto found = ascend<Frame>(scratch.ascent, star, qualities, Objective<M, false, double, Value::Metric, View>{View(star)});
    if (found == OffsetIn<Frame, double>{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

 private:
  RuleMesh<Frame> mesh_;
};

/// By a metric that is defined by a formula or a target.
template <class Frame>
class DefinedActiveSet {
 public:
  struct Scratch {
    DefinedPieces<Frame> pieces;
    AscentScratch<Frame> ascent;
  };
  explicit DefinedActiveSet(const SmoothingTask& task) : mesh_(*task.input, task.metric) {}

  void begin(const Sweep& sweep) { mesh_.begin(sweep); }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    const DefinedStar<Frame> star(mesh_.star_judge(), positions, vertex);
    scratch.pieces.gather(mesh_.star_judge(), positions, vertex, star.scale());
    using V = OffsetIn<Frame, double>;
    const auto qualities = [&](auto p, const auto& f) { scratch.pieces.for_qualities(p, f); };
    const auto found = ascend<Frame>(scratch.ascent, star.star(), qualities, [&star](V p) { return star.least(p); });
    if (found == V{}) return std::nullopt;
    return mesh_.moved_if_gaining(positions, vertex, times(found, star.scale()));
  }

 private:
  DefinedRuleMesh<Frame> mesh_;
};

}  // namespace

std::unique_ptr<Smoother> make_active_set_smoother(const SmoothingTask& task) {
  if (!is_built_in(task.metric))
    return with_frame(*task.input, [&]<class Frame>() { return make_rule_smoother(task, DefinedActiveSet<Frame>(task)); });
  return with_metric_and_frame(*task.input, task.metric,
                               [&]<Metric M, class Frame>() { return make_rule_smoother(task, ActiveSet<M, Frame>(task)); });
}

}  // namespace dmoscope
