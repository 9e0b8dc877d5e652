// Angle-based smoothing (Zhou and Shimada 2000): each vertex goes to the mean of the places at which it halves the angles of the ring of
// its edge neighbours, one place per angle, even if elements become worse.

#include <vector>

#include "core/smooth/visit/visit.h"

namespace dmoscope {

namespace {

using V = Vec2<double>;

/// Edge of the ring that an element cuts off: from the neighbour after the vertex to the one before it, relative to the vertex.
struct RingEdge {
  Index from, to;
  V at_from, at_to;
};

V unit(V a) {
  const double length = std::hypot(a.x, a.y);
  return length > 0.0 ? V{a.x / length, a.y / length} : V{};
}

/// Direction that halves the angle from u counter-clockwise to w, of length 1; 0 where both are 0.
V halfway(V u, V w) {
  const V sum = u + w, difference = u - w;  // both on the line wanted, the latter after a quarter turn
  if (dot(difference, difference) >= dot(sum, sum)) return unit({-difference.y, difference.x});
  return cross(u, w) >= 0.0 ? unit(sum) : unit(V{} - sum);
}

/// Mean of the places that halve the angles of the ring around a vertex, as seen in the plane that touches the surface there.
class HalvedAngles {
 public:
  static constexpr bool kSearches = false, kPlanar = true, kDependsOnIteration = false;
  explicit HalvedAngles(double relaxation) : relaxation_(relaxation) {}

  [[nodiscard]] bool must_gain() const noexcept { return false; }
  template <class Places>
  [[nodiscard]] typename Places::Coordinates choose(const Places& places) const {
    thread_local std::vector<RingEdge> ring;  // kept: a visit allocates nothing
    gather(places, ring);
    V sum{};
    int count = 0;
    // Pairs the ring's edges in any order, for it need not be one loop: an angle is wherever one edge ends and another begins.
    for (const RingEdge& in : ring)
      for (const RingEdge& out : ring) {
        if (out.from != in.to) continue;
        const V corner = in.at_to, towards = halfway(unit(out.at_to - corner), unit(in.at_from - corner));
        const double radius = std::hypot(corner.x, corner.y);
        sum = sum + corner + V{radius * towards.x, radius * towards.y};
        ++count;
        break;
      }
    if (count == 0) return places.way(places.here());
    const double share = relaxation_ / count;
    return places.way_along({share * sum.x, share * sum.y});
  }

 private:
  template <class Places>
  static void gather(const Places& places, std::vector<RingEdge>& ring) {
    ring.clear();
    const Plane& plane = places.plane();
    places.for_star([&](std::span<const Index> corners, Index corner, PositionView positions) {
      const Index from = corners[(corner + 1) % corners.size()], to = corners[(corner + corners.size() - 1) % corners.size()];
      const Vec3 origin = positions[corners[corner]];
      ring.push_back({from, to, plane.offset(positions[from], origin), plane.offset(positions[to], origin)});
    });
  }

  double relaxation_;  // the share of the way that the vertex goes
};

}  // namespace

std::unique_ptr<Smoother> make_angle_based_smoother(const SmoothingTask& task) {
  return make_visits(task, single_objective(task.metric), HalvedAngles(task.options.relaxation));
}

}  // namespace dmoscope
