#include "core/smooth/methods/laplace.h"

#include "core/smooth/edge_neighbours.h"
#include "core/smooth/methods/defined_rule.h"
#include "core/smooth/methods/slide.h"

namespace dmoscope {

namespace {

using Scratch = std::vector<Index>;  // the neighbours

/// From a free vertex to the mean of its edge neighbours.
template <class Frame>
class WayToMean {
 public:
  WayToMean(const Frame& frame, PositionView positions, Index vertex) : frame_(frame), positions_(positions), origin_(positions[vertex]) {}
  void operator()(Index other) {
    sum_ = sum_ + frame_.difference(positions_[other], origin_);
    count_ += 1.0;
  }
  [[nodiscard]] Vec3 way() const { return 1.0 / count_ * sum_; }

 private:
  const Frame& frame_;
  PositionView positions_;
  Vec3 origin_, sum_{};
  double count_ = 0.0;
};

Vec3 way_to_mean(const PlanarView& mesh, PositionView positions, Index vertex, Scratch& /*scratch*/) {
  WayToMean mean(mesh.frame, positions, vertex);
  for_edge_neighbours(mesh, vertex, [&](Index other) { mean(other); });
  return mean.way();
}
Vec3 way_to_mean(const VolumeView& mesh, PositionView positions, Index vertex, Scratch& scratch) {
  WayToMean mean(mesh.frame, positions, vertex);
  gather_edge_neighbours(mesh, vertex, scratch);
  for (const Index other : scratch) mean(other);
  return mean.way();
}

template <class Frame>
class Laplace {
 public:
  using Scratch = dmoscope::Scratch;
  explicit Laplace(const SmoothingTask& task) : mesh_(*task.input), relaxation_(task.options.relaxation) {}

  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    return mesh_.moved(positions[vertex], step(positions, vertex, scratch));
  }

 protected:
  [[nodiscard]] OffsetIn<Frame, double> step(PositionView positions, Index vertex, Scratch& scratch) const {
    return times(mesh_.view.frame.project(way_to_mean(mesh_.view, positions, vertex, scratch)), relaxation_);
  }

  RuleMesh<Frame> mesh_;
  double relaxation_;
};

template <Metric M, class Frame>
class SmartLaplace : private Laplace<Frame> {
 public:
  using typename Laplace<Frame>::Scratch;
  using Laplace<Frame>::Laplace;
  void begin(const Sweep& sweep) { this->mesh_.untangling = sweep.untangling; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    return this->mesh_.template moved_if_gaining<M>(positions, vertex, this->step(positions, vertex, scratch));
  }
};

/// By a metric that is defined by a formula or a target.
template <class Frame>
class DefinedSmartLaplace : private Laplace<Frame> {
 public:
  using typename Laplace<Frame>::Scratch;
  explicit DefinedSmartLaplace(const SmoothingTask& task) : Laplace<Frame>(task), judged_(*task.input, task.metric) {}
  void begin(const Sweep& sweep) { judged_.begin(sweep); }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    return judged_.moved_if_gaining(positions, vertex, this->step(positions, vertex, scratch));
  }

 private:
  DefinedRuleMesh<Frame> judged_;
};

}  // namespace

std::unique_ptr<Smoother> make_laplace_smoother(const SmoothingTask& task) {
  const SlideChoice choice{.by = SlideChoice::By::Mean, .relaxation = task.options.relaxation, .must_gain = false};
  const CompositeObjective objective = single_objective(task.metric);
  if (task.input->is_surface()) return make_surface_smoother(task, objective, choice);
  if (task.input->is_volume()) return make_sliding_smoother<Space>(task, Laplace<Space>(task), objective, choice);
  return make_sliding_smoother<Plane>(task, Laplace<Plane>(task), objective, choice);
}

std::unique_ptr<Smoother> make_smart_laplace_smoother(const SmoothingTask& task) {
  const SlideChoice choice{.by = SlideChoice::By::Mean, .relaxation = task.options.relaxation};
  if (task.input->is_surface()) return make_surface_smoother(task, single_objective(task.metric), choice);
  if (!is_built_in(task.metric))
    return with_frame(*task.input, [&]<class Frame>() {
      return make_sliding_smoother<Frame>(task, DefinedSmartLaplace<Frame>(task), single_objective(task.metric), choice);
    });
  return with_metric_and_frame(*task.input, task.metric, [&]<Metric M, class Frame>() {
    return make_sliding_smoother<Frame>(task, SmartLaplace<M, Frame>(task), single_objective(M), choice);
  });
}

}  // namespace dmoscope
