#include "core/smooth/methods/pattern_search.h"

#include <initializer_list>
#include <variant>

#include "core/search/compass_search.h"
#include "core/smooth/methods/defined_rule.h"
#include "core/smooth/methods/slide.h"

namespace dmoscope {

namespace {

/// Mean of lengths.
class Mean {
 public:
  template <class Point>
  void add(Point p) {
    sum_ += std::sqrt(dot(p, p));
    count_ += 1.0;
  }
  [[nodiscard]] double value() const { return count_ > 0.0 ? sum_ / count_ : 0.0; }

 private:
  double sum_ = 0.0, count_ = 0.0;
};

/// Mean length of the edges at the vertex; an edge counts once for each of its elements.
double mean_edge(const Star<double>& star) {
  Mean mean;
  for (const StarTriangle<double>& t : star.triangles) mean.add(t.b), mean.add(t.c);
  for (const StarQuadrilateral<double>& q : star.quadrilaterals) mean.add(q.b), mean.add(q.d);
  return mean.value();
}
double mean_edge(const VolumeStar<double>& star) {
  Mean mean;
  for (const auto& t : star.tetrahedra) mean.add(t.b), mean.add(t.c), mean.add(t.d);
  const auto add = [&mean](const auto& list, std::initializer_list<std::size_t> ends) {
    for (const auto& element : list)
      for (const std::size_t i : ends) mean.add(element.others[i - 1]);
  };
  add(star.hexahedra, {1, 3, 4});
  add(star.wedges, {1, 2, 3});
  add(star.pyramids, {1, 3, 4});
  for (const auto& tip : star.tips)
    for (const Vec3 p : tip.base) mean.add(p);
  return mean.value();
}

template <Metric M, class Frame>
class PatternSearch {
 public:
  using Scratch = StarIn<Frame, double>;
  explicit PatternSearch(const SmoothingTask& task) : mesh_(*task.input) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& star) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), star);
    const Offset found = search(star);
    if (found == Offset{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

 private:
  using Offset = OffsetIn<Frame, double>;
  [[nodiscard]] Offset search(const Scratch& star) const {
    using View = StarViewIn<Frame, double>;
    const UntanglingObjective<M, View, Offset> untangling(View(star), mesh_.untangling);
    const double edge = mean_edge(star);
    if (untangling.tangled()) return compass_search<Offset>(untangling, edge);
    return compass_search<Offset>(Objective<M, false, double, Value::Metric, View>(View(star)), edge);
  }

  RuleMesh<Frame> mesh_;
};

/// By a metric that is defined by a formula or a target.
template <class Frame>
class DefinedPatternSearch {
 public:
  using Scratch = std::monostate;
  explicit DefinedPatternSearch(const SmoothingTask& task) : mesh_(*task.input, task.metric) {}

  void begin(const Sweep& sweep) { mesh_.begin(sweep); }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& /*scratch*/) const {
    const StarState before = mesh_.state(positions, vertex, positions[vertex]);
    const DefinedStar<Frame> star(mesh_.star_judge(), positions, vertex);
    using View = typename DefinedStar<Frame>::View;
    const double edge = mean_edge(star.star());
    const auto worth = [&star](Offset p) { return positive(star.least(p)); };
    const Offset found =
        before.jacobian > 0.0
            ? compass_search<Offset>(worth, edge)
            : compass_search<Offset>(UntanglingObjective<kDefinedMetric, View, Offset>(star.view(), mesh_.untangling()), edge);
    if (found == Offset{}) return std::nullopt;
    return mesh_.moved_if_gaining(positions, vertex, times(found, star.scale()), before);
  }

 private:
  using Offset = OffsetIn<Frame, double>;
  /// Of a sound star above 0, whatever the metric says of it.
  static double positive(double least) {
    if (least <= DefinedStar<Frame>::kInverted) return 0.0;
    return least > 0.0 ? 1.0 + least : 1.0 / (1.0 - least);
  }
  DefinedRuleMesh<Frame> mesh_;
};

}  // namespace

std::unique_ptr<Smoother> make_pattern_search_smoother(const SmoothingTask& task) {
  const SlideChoice choice{.by = SlideChoice::By::Compass};
  if (task.input->is_surface()) return make_surface_smoother(task, single_objective(task.metric), choice);
  if (!is_built_in(task.metric))
    return with_frame(*task.input, [&]<class Frame>() {
      return make_sliding_smoother<Frame>(task, DefinedPatternSearch<Frame>(task), single_objective(task.metric), choice);
    });
  return with_metric_and_frame(*task.input, task.metric, [&]<Metric M, class Frame>() {
    return make_sliding_smoother<Frame>(task, PatternSearch<M, Frame>(task), single_objective(M), choice);
  });
}

}  // namespace dmoscope
