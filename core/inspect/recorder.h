#pragma once
// Recorder of a visit's search.

#include <algorithm>
#include <memory>
#include <vector>

#include "core/inspect/visit_trace.h"
#include "core/quality/defined_quality.h"
#include "core/quality/element_shape.h"
#include "core/smooth/visit/visit_watcher.h"

namespace dmoscope {

/// Recorder of the search that a visit tells of last. Offset: Vec2<double> or Vec3.
template <class Offset>
class Recorder final : public VisitWatcher {
 public:
  void begin(const Begin& search) override {
    search_ = search;
    levels_.clear();
    found_ = offset(search.start);
    halvings_ = 0;
  }
  void level(Vec3 centre, Vec3 size, int points) override {
    TracedLevelIn<Offset>& level = levels_.emplace_back();
    level.centre = offset(centre);
    level.size = offset(size);
    level.points = points;
  }
  void candidate(Vec3 at, double score) override {
    levels_.back().offsets.push_back(offset(at));
    levels_.back().values.push_back(score);
  }
  void found(Vec3 best) override {
    if (offset(best) == found_) return;
    found_ = offset(best);
    TracedLevelIn<Offset>& level = levels_.back();
    const auto at = std::ranges::find(level.offsets, found_);
    if (at != level.offsets.end()) level.best = static_cast<int>(at - level.offsets.begin());
  }
  void judged(Confirmation found) override { halvings_ += found == Confirmation::TooFar ? 1 : 0; }

  /// Moves the recording to a trace. quality(offset): that of a candidate.
  template <class Quality>
  void give(VisitTraceIn<Offset>& trace, const Quality& quality) {
    trace.value_here = search_.here;
    trace.value_at_start = search_.at_start;
    trace.levels = std::move(levels_);
    trace.found = trace.start = offset(search_.start);
    trace.halvings = halvings_;
    for (TracedLevelIn<Offset>& level : trace.levels) {
      for (const Offset& at : level.offsets) level.quality.push_back(quality(at));
      if (level.best) trace.found = level.at(*level.best);
    }
  }
  [[nodiscard]] const Begin& search() const noexcept { return search_; }

 private:
  [[nodiscard]] static Offset offset(Vec3 p) {
    if constexpr (std::is_same_v<Offset, Vec3>)
      return p;
    else
      return {p.x, p.y};
  }

  Begin search_;
  std::vector<TracedLevelIn<Offset>> levels_;
  Offset found_{};  // best place so far
  int halvings_ = 0;
};

// Qualities of the elements around a vertex before and after a visit, by the statistics' formulas.

/// Whether elements of the star are judged corner by corner. See VisitSummary::by_corners.
template <class Frame>
[[nodiscard]] bool has_corners(const MeshView<Frame>& mesh, Index vertex) {
  const auto is_cornered = [&mesh](const Incidence& at) { return mesh.corners_of(at.element).size() > 4; };
  return std::is_same_v<Frame, Space> && std::ranges::any_of(mesh.star(vertex), is_cornered);
}

/// The changes of a vertex's elements by a completed visit. Frame: Plane, Space or Curved.
template <class Frame>
[[nodiscard]] std::vector<ElementChange> element_changes(const InputMesh& input, PositionView positions, const VisitSummary& visit) {
  const MeshView<Frame> mesh = input.view<Frame>();
  std::shared_ptr<const DefinedJudge> defined;
  if (!is_built_in(visit.metric)) defined = input.quality_context().judge(visit.metric);
  const auto judge = [&](Index element, Vec3 place, double& quality, bool& inverted) {
    const auto corners = mesh.corners_of(element);
    const auto at = [&](Index v) { return v == visit.vertex ? place : positions[v]; };
    visit_shape(mesh.frame_of(element), corners, at, [&](const auto& shape) {
      const auto built_in = [&shape]<Metric M>() { return evaluate<M>(shape); };
      if (defined)
        quality =
            defined_quality_at(*defined, {input.geometry, input.surface_normals}, input.mesh.elements.kind(element), corners, element, at);
      else if constexpr (std::is_same_v<Frame, Space>)
        quality = formulas::with_volume_metric(visit.metric, built_in);
      else
        quality = formulas::with_planar_metric(visit.metric, built_in);
      inverted = least_jacobian(shape) <= 0.0;
    });
  };
  std::vector<ElementChange> changes;
  for (const Incidence& incidence : mesh.star(visit.vertex)) {
    ElementChange& change = changes.emplace_back(ElementChange{incidence.element});
    judge(incidence.element, visit.from, change.before, change.inverted_before);
    judge(incidence.element, visit.to, change.after, change.inverted_after);
  }
  return changes;
}

}  // namespace dmoscope
