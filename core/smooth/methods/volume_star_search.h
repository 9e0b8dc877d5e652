#pragma once
// Fast search of a volume's star, in float by the kernel.

#include <optional>
#include <vector>

#include "core/smooth/composite_objective.h"
#include "core/smooth/kernels/compiled/kernel_set.h"
#include "core/smooth/methods/star_points.h"

namespace dmoscope {

/// Fast search by a metric for a star of a volume.
class VolumeStarSearch {
 public:
  struct Points : StarPoints<Space> {
    std::vector<Vec3Of<float>> narrow;  // the offsets
    Vec3Of<float> narrow_box;
  };
  VolumeStarSearch(Metric metric, const SearchParameters& parameters)
      : metric_(metric),
        kernel_(kernels(parameters).volume(metric)),
        guard_kernel_(kernels(parameters).volume(kGuard)),
        parameters_(parameters) {}
  /// Searches by the mean ratio against targets.
  VolumeStarSearch(const SearchParameters& parameters, bool crossed)
      : metric_(Metric::MeanRatio),
        kernel_(kernels(parameters).target_volume(crossed)),
        guard_kernel_(kernels(parameters).volume(kGuard)),
        parameters_(parameters) {}

  /// Finds the winner of the first `levels` levels for the vertex; a search of fewer levels begins like one of more. Not ready where the
  /// plain search is needed.
  [[nodiscard]] VolumeFound find(const IndexedStars::Star& star, PositionView positions, Index vertex, int levels, Points& points,
                                 const VolumeTargets& targets = {}) const;
  /// Returns whether the vertex would gain by going to `target`, as gains_at() has it where no element is inverted; none where that has to
  /// decide. `points`: as find() left them.
  [[nodiscard]] std::optional<bool> gains(const IndexedStars::Star& star, const Points& points, Vec3 from, Vec3 target,
                                          const VolumeTargets& targets = {}) const;
  /// Returns whether the star's elements are certain to be valid inside with the vertex at `target`. `points`: as find() left them.
  [[nodiscard]] bool valid_at(const IndexedStars::Star& star, const Points& points, Vec3 target) const {
    return kernel_.valid_after({star.elements, points.at.data(), target, target});
  }
  /// Returns whether the star is certain to keep a guard with the vertex at `target`. `points`: as find() left them.
  [[nodiscard]] bool keeps(const Guard& guard, const IndexedStars::Star& star, const Points& points, Vec3 target) const;

 private:
  static constexpr Metric kGuard = Metric::MeanRatio;  // metric of the guards that kernels judge

  Metric metric_;
  VolumeKernel kernel_, guard_kernel_;
  SearchParameters parameters_;
};

}  // namespace dmoscope
