// Laplacian smoothing: each vertex goes to the mean of its edge neighbours, even if elements become worse; or, smart (Freitag 1997), only
// where it gains.

#include "core/smooth/visit/visit.h"

namespace dmoscope {

namespace {

/// Mean of the neighbours: for a free vertex those that share an edge with it, on a surface those that share one of its edges, on a curve
/// the two along it.
class Mean {
 public:
  static constexpr bool kSearches = false, kPlanar = false, kDependsOnIteration = false;
  Mean(const SmoothingTask& task, bool must_gain) : relaxation_(task.options.relaxation), must_gain_(must_gain) {}

  [[nodiscard]] bool must_gain() const noexcept { return must_gain_; }
  template <class Places>
  [[nodiscard]] typename Places::Coordinates choose(const Places& places) const {
    return places.way_to_mean(relaxation_);
  }

 private:
  double relaxation_;  // the share of the way that the vertex goes
  bool must_gain_;
};

}  // namespace

std::unique_ptr<Smoother> make_laplace_smoother(const SmoothingTask& task) {
  return make_visits(task, single_objective(task.metric), Mean(task, false));
}

std::unique_ptr<Smoother> make_smart_laplace_smoother(const SmoothingTask& task) {
  return make_visits(task, objective_of(task), Mean(task, true));
}

}  // namespace dmoscope
