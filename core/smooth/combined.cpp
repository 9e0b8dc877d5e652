#include "core/smooth/combined.h"

#include <array>

#include "core/smooth/edge_neighbours.h"

namespace dmoscope {

namespace {

template <Metric M>
double mean_of_star(const PlanarView& mesh, PositionView positions, Index vertex, Vec3 place) {
  const auto at = [&](Index v) { return v == vertex ? place : positions[v]; };
  double sum = 0.0;
  for (const Incidence& incidence : mesh.star(vertex))
    visit_planar(mesh.frame, mesh.corners_of(incidence.element), at, [&sum](const auto& shape) { sum += evaluate<M>(shape); });
  return sum / static_cast<double>(mesh.star(vertex).size());
}

template <Metric M, bool Untangling>
double worth_at(const StarView<double>& star, Vec2<double> p) {
  return Objective<M, Untangling, double>(star)(p);
}

template <Metric M>
double mean_at(const StarView<double>& star, Vec2<double> p) {
  using V = Vec2<double>;
  double sum = 0.0;
  for (const StarTriangle<double>& t : star.triangles()) sum += evaluate<M>(formulas::Triangle<V>(p, t.b, t.c));
  for (const StarQuadrilateral<double>& q : star.quadrilaterals()) sum += evaluate<M>(formulas::Quadrilateral<V>(p, q.b, q.c, q.d));
  return sum / static_cast<double>(star.triangles().size() + star.quadrilaterals().size());
}

std::array<MetricFunctions, kMetricCount> make_table() {
  std::array<MetricFunctions, kMetricCount> table{};
  for (const MetricInfo& entry : metric_table())
    table[static_cast<std::size_t>(entry.metric)] = formulas::with_planar_metric(entry.metric, []<Metric M>() {
      return MetricFunctions{star_state<M>, mean_of_star<M>, worth_at<M, false>, worth_at<M, true>, mean_at<M>};
    });
  return table;
}

}  // namespace

const MetricFunctions& metric_functions(Metric metric) {
  static const auto table = make_table();
  return table[static_cast<std::size_t>(metric)];
}

Aims aims_of(Metric first, const Combination& combination, std::shared_ptr<const SizeField> size) {
  if (size) return {first, combination.threshold, std::move(size)};
  return {first, combination.threshold, std::get<Metric>(combination.second)};
}

Aims raise_mean_above(Metric metric, double floor) { return {metric, floor > 0.0 ? floor : 0.0, MeanOfStar{}}; }

std::optional<Aims> aims_of_visit(Metric metric, const std::optional<Combination>& combination,
                                  const std::shared_ptr<const SizeField>& size, const Sweep& sweep) {
  if (sweep.floor) return raise_mean_above(metric, *sweep.floor);
  if (combination) return aims_of(metric, *combination, size);
  return std::nullopt;
}

DensityTarget density_target(const SizeField& size, const PlanarView& mesh, PositionView positions, Index vertex) {
  const Vec3 here = positions[vertex];
  Vec2<double> sum{};
  double weights = 0.0, lengths = 0.0;
  std::size_t count = 0;
  for_edge_neighbours(mesh, vertex, [&](Index other) {
    const Vec2<double> edge = mesh.frame.project(positions[other] - here);
    const double weight = 1.0 / size.at(other, positions[other]);
    sum = {sum.x + weight * edge.x, sum.y + weight * edge.y};
    weights += weight;
    lengths += std::sqrt(dot(edge, edge));
    ++count;
  });
  if (count == 0) return {};
  return {{sum.x / weights, sum.y / weights}, lengths / static_cast<double>(count)};
}

DensityTarget CombinedSearch::density_of(const Star<double>& star, PositionView positions, Index vertex) const {
  const auto* size = std::get_if<std::shared_ptr<const SizeField>>(&aims_.second);
  if (size == nullptr) return {};
  const DensityTarget found = density_target(**size, mesh_.view, positions, vertex);
  return {{found.offset.x / star.scale, found.offset.y / star.scale}, found.edge / star.scale};
}

/// The second aim with the vertex at `place`.
double CombinedSearch::second(PositionView positions, Index vertex, Vec3 place) const {
  if (const auto* size = std::get_if<std::shared_ptr<const SizeField>>(&aims_.second))
    return density_target(**size, mesh_.view, positions, vertex).density(mesh_.view.frame.project(place - positions[vertex]));
  if (const auto* metric = std::get_if<Metric>(&aims_.second))
    return metric_functions(*metric).state(mesh_.view, positions, vertex, place).quality;
  return metric_functions(aims_.first).mean(mesh_.view, positions, vertex, place);
}

bool CombinedSearch::gains(PositionView positions, Index vertex, Vec3 target) const {
  const auto state = metric_functions(aims_.first).state;
  const Vec3 here = positions[vertex];
  const StarState before = state(mesh_.view, positions, vertex, here), after = state(mesh_.view, positions, vertex, target);
  const auto second_rises = [&] { return second(positions, vertex, target) > second(positions, vertex, here); };
  if (!(before.jacobian > 0.0)) {
    if (!after.better_than(before)) return false;
    // Raising the mean lowers neither the minimum nor the mean, not even for the sake of untangling.
    return !aims_.raise_mean() || (after.quality >= before.quality && second_rises());
  }
  if (!(after.jacobian > 0.0)) return false;
  if (!aims_.beyond(before.quality)) return after.quality > before.quality;
  return aims_.beyond(after.quality) && second_rises();
}

std::optional<Vec3> CombinedSearch::target(PositionView positions, Index vertex, Room& star) const {
  gather_star(MeshStar(mesh_.view, positions, vertex), star);
  const Vec2<double> found = search(star, positions, vertex).offset;
  if (found.x == 0.0 && found.y == 0.0) return std::nullopt;
  const auto target = mesh_.moved(positions[vertex], {found.x * star.scale, found.y * star.scale});
  return target && gains(positions, vertex, *target) ? target : std::nullopt;
}

std::unique_ptr<Smoother> make_combined_smoother(const SmoothingTask& task) {
  return make_rule_smoother(task, CombinedSearch(*task.input, aims_of(task.metric, *task.combination, task.size), task.search));
}

}  // namespace dmoscope
