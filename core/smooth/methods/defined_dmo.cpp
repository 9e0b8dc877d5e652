#include "core/smooth/methods/defined_dmo.h"

#include "core/search/grid_search.h"
#include "core/smooth/methods/defined_rule.h"
#include "core/smooth/methods/defined_search.h"
#include "core/smooth/methods/slide.h"

namespace dmoscope {

namespace {

/// One vertex's visit: a rule for RuleSmoother.
template <class Frame>
class DefinedDmo {
 public:
  using Scratch = typename DefinedSearch<Frame>::Scratch;
  static constexpr bool kDependsOnStarAlone = true;
  static constexpr std::size_t kGrain = std::is_same_v<Frame, Plane> ? 64 : 8;

  explicit DefinedDmo(const SmoothingTask& task)
      : mesh_(*task.input, task.metric), parameters_(task.search), search_(mesh_.star_judge(), task.search) {}

  void begin(const Sweep& sweep) { mesh_.begin(sweep); }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    const StarState before = mesh_.state(positions, vertex, positions[vertex]);
    const bool tangled = !(before.jacobian > 0.0);
    if (mesh_.untangling().repair && !tangled) return std::nullopt;
    const Offset found = tangled ? search_tangled(positions, vertex) : search_sound(positions, vertex, scratch);
    if (found == Offset{}) return std::nullopt;
    return mesh_.moved_if_gaining(positions, vertex, found, before);
  }

 private:
  using Offset = OffsetIn<Frame, double>;  // in mesh units

  [[nodiscard]] Offset search_sound(PositionView positions, Index vertex, Scratch& scratch) const {
    const auto found = search_.find(positions, vertex, parameters_.levels, scratch);
    return times(found.offset, found.scale);
  }
  [[nodiscard]] Offset search_tangled(PositionView positions, Index vertex) const {
    const DefinedStar<Frame> star(mesh_.star_judge(), positions, vertex);
    return times(search_star<kDefinedMetric>(star.view(), star.star().box, parameters_, mesh_.untangling()), star.scale());
  }

  DefinedRuleMesh<Frame> mesh_;
  SearchParameters parameters_;
  DefinedSearch<Frame> search_;
};

}  // namespace

std::unique_ptr<Smoother> make_defined_dmo_smoother(const SmoothingTask& task) {
  return with_frame(*task.input, [&]<class Frame>() {
    return make_sliding_smoother<Frame>(task, DefinedDmo<Frame>(task), single_objective(task.metric));
  });
}

}  // namespace dmoscope
