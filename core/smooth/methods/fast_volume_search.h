#pragma once
// The fast search of a volume's star: in float by the kernel, confirmed in double.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/smooth/kernels/volume_kernel.h"
#include "core/smooth/task.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

/// The places of a star's other vertices.
struct VolumePoints {
  std::vector<Vec3> exact;           // positions
  std::vector<Vec3Of<float>> fast;   // from the vertex, in units of scale
  Vec3Of<float> box;                 // see MeshStar
  double scale = 1.0;
};

/// The fast search by a metric for a star of a volume.
class VolumeStarSearch {
 public:
  VolumeStarSearch(Metric metric, const SearchParameters& parameters)
      : kernel_(volume_kernel(parameters.simd.value_or(best_simd_level()), metric)), parameters_(parameters) {}

  /// What the kernel finds within `levels` levels for the vertex; a search of fewer levels begins like one of more. Not ready where the
  /// plain search has to do it.
  [[nodiscard]] VolumeFound find(const IndexedStars::Star& star, PositionView positions, Index vertex, int levels, VolumePoints& points) const;
  /// What the star is worth in double with the vertex at either of two places. `points`: as find() left them.
  [[nodiscard]] VolumeRanks compare(const IndexedStars::Star& star, const VolumePoints& points, Vec3 before, Vec3 after) const {
    return kernel_.compare({star.elements, points.exact.data(), before, after});
  }

 private:
  VolumeKernel kernel_;
  SearchParameters parameters_;
};

/// The fast search for a vertex, and the plain one for stars that the fast one cannot handle: with inverted or nearly inverted elements, or
/// too many. The mesh must outlive it.
template <Metric M>
class FastVolumeSearch {
 public:
  struct Scratch {
    VolumePoints points;
    VolumeStar<double> star;  // for the plain search
  };
  static constexpr bool kDependsOnStarAlone = true;
  static constexpr std::size_t kGrain = 16;
  explicit FastVolumeSearch(const SmoothingTask& task)
      : mesh_(*task.input),
        parameters_(task.search),
        search_(M, task.search),
        stars_(std::make_shared<const IndexedStars>(task.input->mesh, task.input->topology, *task.colouring, task.pool)) {}

  void begin(const Sweep& sweep) { mesh_.untangling = sweep.untangling; }
  [[nodiscard]] std::span<const Index> others(Index vertex) const { return stars_->of(vertex).vertices; }
  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    const IndexedStars::Star star = stars_->of(vertex);
    const VolumeFound found =
        mesh_.untangling.repair ? VolumeFound{} : search_.find(star, positions, vertex, parameters_.levels, scratch.points);
    if (!found.ready) return target_by_plain_search(positions, vertex, scratch.star);
    const Vec3 offset{found.offset.x, found.offset.y, found.offset.z};
    if (offset == Vec3{}) return std::nullopt;
    const std::optional<Vec3> target = mesh_.moved(positions[vertex], times(offset, scratch.points.scale));
    return target && gains(star, positions, vertex, *target, scratch.points) ? target : std::nullopt;
  }

 private:
  /// As gains_at(), by ranks where they tell.
  [[nodiscard]] bool gains(const IndexedStars::Star& star, PositionView positions, Index vertex, Vec3 target, const VolumePoints& points) const {
    constexpr double kLeastCertain = 1e-4, kDoubt = 1e-8;  // far more than ranks above that differ by rounding
    if (formulas::kDefinedForCorners<M> || has_tetrahedra_alone(star.elements)) {
      const VolumeRanks rank = search_.compare(star, points, positions[vertex], target);
      if (rank.before > kLeastCertain && rank.after > rank.before * (1.0 + kDoubt)) return true;
      if (rank.before > kLeastCertain && rank.after < rank.before * (1.0 - kDoubt)) return false;
    }
    return gains_at<M>(mesh_.view, positions, vertex, target, mesh_.untangling);
  }
  [[nodiscard]] static bool has_tetrahedra_alone(const IndexedStar& star) {
    for (std::size_t kind = 1; kind < kStarKinds; ++kind)
      if (star.counts[kind] > 0) return false;
    return true;
  }

  std::optional<Vec3> target_by_plain_search(PositionView positions, Index vertex, VolumeStar<double>& star) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), star);
    const Vec3 found = search_star<M>(VolumeStarView<double>(star), star.box, parameters_, mesh_.untangling);
    if (found == Vec3{}) return std::nullopt;
    return mesh_.template moved_if_gaining<M>(positions, vertex, found, star.scale);
  }

  RuleMesh<Space> mesh_;
  SearchParameters parameters_;
  VolumeStarSearch search_;
  std::shared_ptr<const IndexedStars> stars_;  // shared: the rule is moved about
};

}  // namespace dmoscope
