#pragma once
// What spares a visit with two aims in a volume most of its work around the search: stars laid out once, and comparisons by the kernels.

#include <optional>

#include "core/smooth/methods/volume_points.h"
#include "core/smooth/task.h"
#include "core/smooth/two_aims.h"

namespace dmoscope {

class VolumeTwoAims {
 public:
  /// `aims`: of two metrics, or of the mean.
  VolumeTwoAims(const SmoothingTask& task, Metric first, const Aims& aims);

  [[nodiscard]] IndexedStars::Star star_of(Index vertex) const { return stars_.of(vertex); }
  /// Fills `points` and, but for the reference measures, `star`, as gather_star() does; false where the star is not for the kernels.
  [[nodiscard]] bool gather(PositionView positions, Index vertex, VolumePoints& points, VolumeStar<double>& star) const;
  /// Would the vertex gain by going to `target`, as gains_by_two() has it where no element is inverted? Nothing where that has to say.
  /// `points`: as gather() left them.
  [[nodiscard]] std::optional<bool> gains(Index vertex, const VolumePoints& points, Vec3 from, Vec3 target) const;

 private:
  [[nodiscard]] BeforeAndAfter least(Metric metric, const VolumeKernel& kernel, const VolumeComparison& task) const;

  IndexedStars stars_;
  Metric first_;
  Aims aims_;
  VolumeKernel first_kernel_, second_kernel_;
};

}  // namespace dmoscope
