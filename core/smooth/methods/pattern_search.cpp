#include "core/smooth/methods/pattern_search.h"

#include <array>

#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

// Ended at 1e-2 it leaves a mean less high, at 1e-4 the same at 1.5 times the cost; shrunk by 0.5 it ends 0.003 lower on one real mesh.
constexpr double kFirst = 0.25, kLast = 1e-3;  // step, in mean edges
constexpr double kGrow = 1.5, kShrink = 0.25, kBacktrack = 0.9;
constexpr int kMostPolls = 100;

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

constexpr std::array<Vec2<double>, 4> compass(Vec2<double> /*of a plane*/) { return {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}; }
constexpr std::array<Vec3, 6> compass(Vec3 /*of space*/) { return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}}; }

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
  struct Try {
    Offset at;
    double worth;
  };

  [[nodiscard]] Offset search(const Scratch& star) const {
    using View = StarViewIn<Frame, double>;
    const UntanglingObjective<M, View, Offset> untangling(View(star), mesh_.untangling);
    if (untangling.tangled()) return search(star, untangling);
    return search(star, Objective<M, false, double, Value::Metric, View>(View(star)));
  }

  template <class Worth>
  static Offset search(const Scratch& star, const Worth& worth) {
    Try best{{}, worth(Offset{})};
    const double edge = mean_edge(star), last = kLast * edge;
    double step = kFirst * edge;
    for (int poll = 0; poll < kMostPolls && step > last; ++poll) {
      const Try found = best_around(worth, best, step, last);
      const bool better = found.worth > best.worth;
      if (better) best = found;
      step *= better ? kGrow : kShrink;
    }
    return best.at;
  }

  /// One step along each axis, forth and back.
  template <class Worth>
  static Try best_around(const Worth& worth, const Try& from, double step, double least) {
    Try best = from;
    for (const Offset d : compass(Offset{})) {
      double length = step;
      const auto at = [&] { return from.at + times(d, length); };
      double value = worth(at());
      // Shorter, while it would invert an element where none is inverted.
      while (from.worth > 0.0 && !(value > 0.0) && length > least) {
        length *= kBacktrack;
        value = worth(at());
      }
      if (value > best.worth) best = {at(), value};
    }
    return best;
  }

  RuleMesh<Frame> mesh_;
};

}  // namespace

std::unique_ptr<Smoother> make_pattern_search_smoother(const SmoothingTask& task) {
  return with_metric_and_frame(*task.input, task.metric,
                               [&]<Metric M, class Frame>() { return make_rule_smoother(task, PatternSearch<M, Frame>(task)); });
}

}  // namespace dmoscope
