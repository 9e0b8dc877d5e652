#include "core/smooth/laplace.h"

#include "core/smooth/edge_neighbours.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

/// From a free vertex to the mean of its edge neighbours.
Vec2<double> way_to_mean(const PlanarView& mesh, PositionView positions, Index vertex) {
  const Vec3 origin = positions[vertex];
  Vec3 sum{};
  double count = 0.0;
  for_edge_neighbours(mesh, vertex, [&](Index other) {
    sum = sum + (positions[other] - origin);
    count += 1.0;
  });
  return mesh.plane.project(1.0 / count * sum);
}

class Laplace {
 public:
  struct Room {};
  explicit Laplace(const SmoothingTask& task) : mesh_(*task.input), relaxation_(task.options.relaxation) {}

  std::optional<Vec3> target(PositionView positions, Index vertex, Room& /*room*/) const {
    return mesh_.moved(positions[vertex], step(positions, vertex));
  }

 protected:
  [[nodiscard]] Vec2<double> step(PositionView positions, Index vertex) const {
    const Vec2<double> way = way_to_mean(mesh_.view, positions, vertex);
    return {relaxation_ * way.x, relaxation_ * way.y};
  }

  RuleMesh mesh_;
  double relaxation_;
};

template <Metric M>
class SmartLaplace : private Laplace {
 public:
  using Laplace::Laplace, Laplace::Room;
  std::optional<Vec3> target(PositionView positions, Index vertex, Room& /*room*/) const {
    return mesh_.moved_if_gaining<M>(positions, vertex, step(positions, vertex));
  }
};

}  // namespace

std::unique_ptr<Smoother> make_laplace_smoother(const SmoothingTask& task) { return make_rule_smoother(task, Laplace(task)); }

std::unique_ptr<Smoother> make_smart_laplace_smoother(const SmoothingTask& task) {
  return formulas::with_metric(task.metric, [&]<Metric M>() { return make_rule_smoother(task, SmartLaplace<M>(task)); });
}

}  // namespace dmoscope
