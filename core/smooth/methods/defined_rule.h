#pragma once
// What rules by a metric that is defined by a formula or a target know of the mesh.

#include <memory>
#include <optional>

#include "core/smooth/defined_state.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

/// Frame: Plane or Space.
template <class Frame>
class DefinedRuleMesh {
 public:
  using Offset = OffsetIn<Frame, double>;
  DefinedRuleMesh(const InputMesh& input, Metric metric)
      : mesh_(input), judge_(input.quality_context().judge(metric)), star_judge_(defined_star_judge<Frame>(input, *judge_)) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  [[nodiscard]] const Untangling& untangling() const { return mesh_.untangling; }
  [[nodiscard]] const RuleMesh<Frame>& mesh() const { return mesh_; }
  [[nodiscard]] const DefinedStarJudge<Frame>& star_judge() const { return star_judge_; }
  [[nodiscard]] StarState state(PositionView positions, Index vertex, Vec3 place) const {
    return defined_star_state(star_judge_, positions, vertex, place);
  }
  /// By an offset in mesh units: where the vertex gains by it, and nowhere else (promise 1). `before`: its star where it stands.
  [[nodiscard]] std::optional<Vec3> moved_if_gaining(PositionView positions, Index vertex, Offset offset, const StarState& before) const {
    return mesh_.moved_if(positions[vertex], offset, [&](Vec3 target) {
      return confirm_from(mesh_.view, positions, vertex, target, mesh_.untangling, before,
                          [&] { return state(positions, vertex, target); });
    });
  }
  [[nodiscard]] std::optional<Vec3> moved_if_gaining(PositionView positions, Index vertex, Offset offset) const {
    return moved_if_gaining(positions, vertex, offset, state(positions, vertex, positions[vertex]));
  }

 private:
  RuleMesh<Frame> mesh_;
  std::shared_ptr<const DefinedJudge> judge_;
  DefinedStarJudge<Frame> star_judge_;
};

/// Calls f.template operator()<Frame>() with the frame of a mesh.
template <class F>
decltype(auto) with_frame(const InputMesh& input, F&& f) {
  if (input.is_volume()) return f.template operator()<Space>();
  return f.template operator()<Plane>();
}

}  // namespace dmoscope
