#include "core/smooth/pattern_search.h"

#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

using V = Vec2<double>;

// Ended at 1e-2 it leaves a mean less high, at 1e-4 the same at 1.5 times the cost; shrunk by 0.5 it ends 0.003 lower on one real mesh.
constexpr double kFirst = 0.25, kLast = 1e-3;  // step, in mean edges
constexpr double kGrow = 1.5, kShrink = 0.25, kBacktrack = 0.9;
constexpr int kMostPolls = 100;

/// Of the edges that leave the vertex; each is in two elements.
double mean_edge(const Star<double>& star) {
  double sum = 0.0, count = 0.0;
  const auto add = [&](V p) { sum += std::hypot(p.x, p.y), count += 1.0; };
  for (const StarTriangle<double>& t : star.triangles) add(t.b), add(t.c);
  for (const StarQuadrilateral<double>& q : star.quadrilaterals) add(q.b), add(q.d);
  return count > 0.0 ? sum / count : 0.0;
}

template <Metric M>
class PatternSearch {
 public:
  using Room = Star<double>;
  explicit PatternSearch(const SmoothingTask& task) : mesh_(*task.input) {}

  std::optional<Vec3> target(PositionView positions, Index vertex, Room& star) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), star);
    const V found = search(star);
    if (found.x == 0.0 && found.y == 0.0) return std::nullopt;
    return mesh_.moved_if_gaining<M>(positions, vertex, {found.x * star.scale, found.y * star.scale});
  }

 private:
  struct Try {
    V at;
    double worth;
  };

  static V search(const Star<double>& star) {
    const Objective<M, true, double> worth{StarView<double>(star)};
    Try best{{}, worth({})};
    const double edge = mean_edge(star), last = kLast * edge;
    double step = kFirst * edge;
    for (int poll = 0; poll < kMostPolls && step > last; ++poll) {
      const Try found = best_of_four(worth, best, step, last);
      const bool better = found.worth > best.worth;
      if (better) best = found;
      step *= better ? kGrow : kShrink;
    }
    return best.at;
  }

  template <class Worth>
  static Try best_of_four(const Worth& worth, const Try& from, double step, double least) {
    Try best = from;
    for (const V d : {V{1, 0}, V{-1, 0}, V{0, 1}, V{0, -1}}) {
      double length = step;
      const auto at = [&] { return V{from.at.x + length * d.x, from.at.y + length * d.y}; };
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

  RuleMesh mesh_;
};

}  // namespace

std::unique_ptr<Smoother> make_pattern_search_smoother(const SmoothingTask& task) {
  return formulas::with_metric(task.metric, [&]<Metric M>() { return make_rule_smoother(task, PatternSearch<M>(task)); });
}

}  // namespace dmoscope
