// Active-set ascent (Freitag, Jones and Plassmann 1995; Mesquite's NonSmoothDescent): the least quality of a star is raised along the
// steepest direction in which none of those that are about the least falls, from one such set to the next.

#include <limits>
#include <vector>

#include "core/smooth/visit/visit.h"

namespace dmoscope {

namespace {

// Limits in units of the star's scale, in which its other vertices are about 1 away.
constexpr double kActive = 3e-5;  // height above the least
constexpr double kLeastStep = 1e-6, kLeastGain = 1e-6, kLongestStep = 1.0;
constexpr double kNearEstimate = 0.9;
constexpr int kSteps = 20;

/// Value and gradient of one of the functions at a place. V: double on a curve, Vec2<double> in a plane, Vec3 in space.
template <class V>
struct Piece {
  double value;
  V gradient;
};
template <class V>
struct AscentScratch {
  std::vector<Piece<V>> pieces;
  std::vector<V> active;  // gradients of the active pieces
};

double times(double a, double s) { return a * s; }
double dot(double a, double b) { return a * b; }
double norm(double a) { return std::abs(a); }
double norm(Vec2<double> a) { return std::hypot(a.x, a.y); }
double norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// Point of the segment from a to b that is nearest to 0.
template <class V>
V nearest_to_zero(V a, V b) {
  const V way = b - a;
  const double square = dot(way, way);
  if (!(square > 0.0)) return a;
  return a + times(way, std::clamp(-dot(a, way) / square, 0.0, 1.0));
}

/// Foot of 0 on the plane of three points, where it lies in their triangle.
std::optional<Vec3> foot_of_zero(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c, n = cross(ab, bc);
  const double square = dot(n, n);
  if (!(square > 1e-24 * dot(ab, ab) * dot(bc, bc))) return std::nullopt;  // the foot is next to a segment
  const Vec3 foot = times(n, dot(n, a) / square);
  const auto inside = [&](Vec3 from, Vec3 edge) { return dot(cross(edge, foot - from), n) >= 0.0; };
  return inside(a, ab) && inside(b, bc) && inside(c, ca) ? std::optional(foot) : std::nullopt;
}

/// Looks for a point nearer to 0 than `best` inside the hull's faces, which the hull has in space alone.
template <class V>
void look_at_faces(const std::vector<V>& /*gradients*/, V& /*best*/) {}
void look_at_faces(const std::vector<Vec3>& gradients, Vec3& best) {
  const std::size_t n = gradients.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k)
      for (std::size_t l = k + 1; l < n; ++l)
        if (const auto foot = foot_of_zero(gradients[i], gradients[k], gradients[l]); foot && dot(*foot, *foot) < dot(best, best))
          best = *foot;
}

/// Point of the gradients' convex hull that is nearest to 0: along it all of them rise, by its length at least. 0 where they cannot.
template <class V>
V steepest(const std::vector<V>& gradients) {
  V best = gradients.front();
  for (std::size_t i = 0; i < gradients.size(); ++i)
    for (std::size_t k = i; k < gradients.size(); ++k) {
      const V p = nearest_to_zero(gradients[i], gradients[k]);
      if (dot(p, p) < dot(best, best)) best = p;
    }
  look_at_faces(gradients, best);
  // Accepts an edge or face of the hull that lies on the wrong side of none of the gradients: that one is its nearest.
  constexpr double kRounding = 1e-9;
  for (const V g : gradients)
    if (dot(g, best) < (1.0 - kRounding) * dot(best, best)) return {};
  return best;
}

/// Raises the least of the pieces from a place. for_pieces(p, f): calls f(value, gradient) of each with the star's vertex at p. worth(p):
/// the least of them, or another score of the place.
template <class V, class ForPieces, class Worth>
class Ascent {
 public:
  Ascent(const ForPieces& for_pieces, const Worth& worth) : for_pieces_(for_pieces), worth_(worth) {}

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
    for_pieces_(place, [&](double value, V gradient) {
      least = std::min(least, value);
      scratch_.pieces.push_back({value, gradient});
    });
    for (const Piece<V>& piece : scratch_.pieces) {
      // Takes the corner across a quadrilateral, which never changes, as active only at the least: above it, it bounds the gain, but is no
      // reason to stay.
      const bool constant = piece.gradient == V{};
      if (piece.value <= least + (constant ? 0.0 : kActive)) scratch_.active.push_back(piece.gradient);
    }
    return least;
  }

  /// Distance at which another piece would be as low as the active ones, if all were linear.
  [[nodiscard]] double next_activation(double least, V unit, double rate) const {
    double nearest = kLongestStep;
    for (const Piece<V>& piece : scratch_.pieces) {
      const double slower = rate - dot(piece.gradient, unit);
      if (piece.value > least + kActive && slower > 0.0) nearest = std::min(nearest, (piece.value - least) / slower);
    }
    return nearest;
  }

  /// Halves the step until it gains about as much as expected, or the last longer one gained more. Returns the gain of the best, at `next`.
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

  static AscentScratch<V>& room() {
    thread_local AscentScratch<V> scratch;  // kept: a visit allocates nothing
    return scratch;
  }

  AscentScratch<V>& scratch_ = room();
  const ForPieces& for_pieces_;
  const Worth& worth_;
};

/// Raises the least of the functions that make up the objective; where an element is inverted the least Jacobian first, by as much as turns
/// it.
class ActiveSet {
 public:
  static constexpr bool kSearches = true, kPlanar = false, kDependsOnIteration = false;
  [[nodiscard]] bool must_gain() const noexcept { return true; }

  template <class Places, class Frame>
  [[nodiscard]] typename Places::Coordinates choose(const Places& places, const StarScore<Frame>& score, SearchRoom<Frame>& room) const {
    using V = typename Places::Coordinates;
    using Offset = OffsetIn<Frame, double>;
    const auto coordinates = [&](V p) { return places.shifted(times(p, places.unit())); };
    const auto offset = [&](V p) { return p == V{} ? std::optional(Offset{}) : places.offset(coordinates(p)); };
    // Calls f(value, gradient) for the pieces that append(offset, out) appends.
    const auto each = [&](V p, const auto& append, const auto& f) {
      const auto at = offset(p);
      room.pieces.clear();
      if (at) append(*at, room.pieces);
      for (const StarPiece<Frame>& piece : room.pieces) f(piece.value, times(places.slope(coordinates(p), piece.gradient), places.unit()));
    };
    const auto jacobians = [&](V p, const auto& f) {
      each(
          p, [&score](Offset at, auto& out) { score.append_jacobians(at, out); }, f);
    };
    const auto least_jacobian = [&](V p) {
      double least = std::numeric_limits<double>::infinity();
      jacobians(p, [&least](double value, V /*gradient*/) { least = std::min(least, value); });
      return room.pieces.empty() ? StarScore<Frame>::kAll : least;
    };
    V place{};
    if (!(least_jacobian(place) > 0.0))
      place = Ascent<V, decltype(jacobians), decltype(least_jacobian)>(jacobians, least_jacobian).from(place);
    if (!(least_jacobian(place) > 0.0)) return places.way(coordinates(place));
    const StarScore<Frame> sound = score.of_sound_star();
    const auto qualities = [&](V p, const auto& f) {
      each(
          p, [&sound](Offset at, auto& out) { sound.append_pieces(at, out); }, f);
    };
    const auto worth = [&](V p) {
      const auto at = offset(p);
      return at ? sound(*at) : StarScore<Frame>::kAll;
    };
    return places.way(coordinates(Ascent<V, decltype(qualities), decltype(worth)>(qualities, worth).from(place)));
  }
};

}  // namespace

std::unique_ptr<Smoother> make_active_set_smoother(const SmoothingTask& task) { return make_visits(task, objective_of(task), ActiveSet{}); }

}  // namespace dmoscope
