#pragma once
// The fast search of a volume's star: in float by the kernel, confirmed in double.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/smooth/methods/star_points.h"
#include "core/smooth/task.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

/// The fast search by a metric for a star of a volume.
class VolumeStarSearch {
 public:
  struct Points : StarPoints<Space> {
    std::vector<Vec3Of<float>> narrow;  // the offsets
    Vec3Of<float> narrow_box;
  };
  VolumeStarSearch(Metric metric, const SearchParameters& parameters)
      : metric_(metric), kernel_(volume_kernel(parameters.simd.value_or(best_simd_level()), metric)), parameters_(parameters) {}
  /// By the mean ratio against targets.
  VolumeStarSearch(const SearchParameters& parameters, bool crossed)
      : metric_(Metric::MeanRatio),
        kernel_(target_volume_kernel(parameters.simd.value_or(best_simd_level()), crossed)),
        parameters_(parameters) {}

  /// What the kernel finds within `levels` levels for the vertex; a search of fewer levels begins like one of more. Not ready where the
  /// plain search has to do it.
  [[nodiscard]] VolumeFound find(const IndexedStars::Star& star, PositionView positions, Index vertex, int levels, Points& points,
                                 const VolumeTargets& targets = {}) const;
  /// Would the vertex gain by going to `target`, as gains_at() has it where no element is inverted? Nothing where that has to say.
  /// `points`: as find() left them.
  [[nodiscard]] std::optional<bool> gains(const IndexedStars::Star& star, const Points& points, Vec3 from, Vec3 target,
                                          const VolumeTargets& targets = {}) const;
  /// Are the star's elements certain to be valid inside with the vertex at `target`? `points`: as find() left them.
  [[nodiscard]] bool valid_at(const IndexedStars::Star& star, const Points& points, Vec3 target) const {
    return kernel_.valid_after({star.elements, points.at.data(), target, target});
  }

 private:
  Metric metric_;
  VolumeKernel kernel_;
  SearchParameters parameters_;
};

/// The fast search for a vertex, and the plain one for stars that the fast one cannot handle: with inverted or nearly inverted elements, or
/// too many. The mesh must outlive it.
template <Metric M>
class FastVolumeSearch {
 public:
  struct Scratch {
    VolumeStarSearch::Points points;
    VolumeStar<double> star;  // for the plain search
  };
  static constexpr std::size_t kGrain = 16;
  explicit FastVolumeSearch(const SmoothingTask& task)
      : mesh_(*task.input),
        parameters_(task.search),
        search_(M, task.search),
        has_inside_(std::ranges::any_of(task.input->mesh.elements.kinds(), &has_inside)),
        stars_(std::make_shared<const IndexedStars>(*task.input, *task.colouring, task.pool)) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  [[nodiscard]] std::span<const Index> others(Index vertex) const { return stars_->of(vertex).vertices; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    const IndexedStars::Star star = stars_->of(vertex);
    const Untangling& rule = mesh_.untangling;
    const bool plain = rule.repair || (has_inside_ && rule.looks_inside() && has_inverted(mesh_.view, positions, vertex));
    const VolumeFound found = plain ? VolumeFound{} : search_.find(star, positions, vertex, parameters_.levels, scratch.points);
    if (!found.ready) return target_by_plain_search(positions, vertex, scratch.star);
    const Vec3 offset{found.offset.x, found.offset.y, found.offset.z};
    if (offset == Vec3{}) return std::nullopt;
    const std::optional<Vec3> target = mesh_.moved(positions[vertex], times(offset, scratch.points.scale));
    if (!target) return std::nullopt;
    const std::optional<bool> known = search_.gains(star, scratch.points, positions[vertex], *target);
    if (known && !*known) return std::nullopt;
    if (known && (!has_inside_ || search_.valid_at(star, scratch.points, *target) || keeps_sound(mesh_.view, positions, vertex, *target)))
      return target;
    return mesh_.template moved_if_gaining<M>(positions, vertex, offset, scratch.points.scale);
  }

 private:
  std::optional<Vec3> target_by_plain_search(PositionView positions, Index vertex, VolumeStar<double>& star) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), star);
    const Vec3 found = search_star<M>(VolumeStarView<double>(star), star.box, parameters_, mesh_.untangling);
    if (found == Vec3{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

  RuleMesh<Space> mesh_;
  SearchParameters parameters_;
  VolumeStarSearch search_;
  bool has_inside_;
  std::shared_ptr<const IndexedStars> stars_;  // shared: the rule is moved about
};

}  // namespace dmoscope
