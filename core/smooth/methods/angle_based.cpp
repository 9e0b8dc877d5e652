#include "core/smooth/methods/angle_based.h"

#include <vector>

#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

using V = Vec2<double>;

/// The ring's edge that an element cuts off: from the neighbour after the vertex to the one before it, relative to the vertex.
struct RingEdge {
  Index from, to;
  V at_from, at_to;
};

V unit(V a) {
  const double length = std::hypot(a.x, a.y);
  return length > 0.0 ? V{a.x / length, a.y / length} : V{};
}

/// The direction that halves the angle from u counter-clockwise to w, of length 1; 0 where both are 0.
V halfway(V u, V w) {
  const V sum = u + w, difference = u - w;  // both are on the line wanted, the latter after a quarter turn
  if (dot(difference, difference) >= dot(sum, sum)) return unit({-difference.y, difference.x});
  return cross(u, w) >= 0.0 ? unit(sum) : unit(V{} - sum);
}

class AngleBased {
 public:
  using Scratch = std::vector<RingEdge>;
  explicit AngleBased(const SmoothingTask& task) : mesh_(*task.input), relaxation_(task.options.relaxation) {}

  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& ring) const {
    gather(positions, vertex, ring);
    V sum{};
    int count = 0;
    // The ring need not be one loop, nor its edges be in order: an angle is wherever one edge ends and another begins.
    for (const RingEdge& in : ring)
      for (const RingEdge& out : ring) {
        if (out.from != in.to) continue;
        const V corner = in.at_to, towards = halfway(unit(out.at_to - corner), unit(in.at_from - corner));
        const double radius = std::hypot(corner.x, corner.y);
        sum = sum + corner + V{radius * towards.x, radius * towards.y};
        ++count;
        break;
      }
    if (count == 0) return std::nullopt;
    const double share = relaxation_ / count;
    return mesh_.moved(positions[vertex], {share * sum.x, share * sum.y});
  }

 private:
  void gather(PositionView positions, Index vertex, Scratch& ring) const {
    ring.clear();
    const Vec3 origin = positions[vertex];
    for (const Incidence& at : mesh_.view.star(vertex)) {
      const auto corners = mesh_.view.corners_of(at.element);
      const Index from = corners[(at.corner + 1) % corners.size()], to = corners[(at.corner + corners.size() - 1) % corners.size()];
      ring.push_back({from, to, mesh_.view.frame.offset(positions[from], origin), mesh_.view.frame.offset(positions[to], origin)});
    }
  }

  RuleMesh<Plane> mesh_;
  double relaxation_;
};

}  // namespace

std::unique_ptr<Smoother> make_angle_based_smoother(const SmoothingTask& task) { return make_rule_smoother(task, AngleBased(task)); }

}  // namespace dmoscope
