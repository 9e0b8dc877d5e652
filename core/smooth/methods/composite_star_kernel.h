#pragma once
// Grid search for two aims by packs of candidates, in double: it finds the same as the plain search.

#include <optional>

#include "core/smooth/composite_visit.h"
#include "core/smooth/kernels/volume_kernel.h"
#include "core/smooth/methods/star_points.h"
#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/star_kernel.h"

namespace dmoscope {

/// Returns whether a vertex gains, as confirm_composite() has it where no element is inverted; none where that has to decide. `first`: the
/// least first metric. second(): the second aim. Both found by the search's formulas; where the star is not certain to be sound, 0.
template <class Second>
[[nodiscard]] std::optional<bool> gains_for_certain(double threshold, BeforeAndAfter first, const Second& second) {
  const auto known = [](Certainty certainty) {
    return certainty == Certainty::Unsure ? std::nullopt : std::optional(certainty == Certainty::Greater);
  };
  if (!(first.before > kLeastCertain) || !(first.after > kLeastCertain)) return std::nullopt;
  const Certainty before_beyond = compare(first.before, threshold), after_beyond = compare(first.after, threshold);
  if (before_beyond == Certainty::Unsure) return std::nullopt;
  if (before_beyond == Certainty::Less) return known(compare(first.after, first.before));
  if (after_beyond != Certainty::Greater) return known(after_beyond);
  const BeforeAndAfter values = second();
  if (!(values.before > kLeastCertain) || !(values.after > kLeastCertain)) return std::nullopt;
  return known(compare(values.after, values.before));
}

/// Comparison of two places in a volume, by the kernels.
class CompositeComparison {
 public:
  /// `aims`: two metrics, or a metric and the mean.
  CompositeComparison(SimdLevel level, Metric first, const PlainComposite& aims);

  /// Returns whether the star's vertex would gain by going to `target`; see gains_for_certain().
  [[nodiscard]] std::optional<bool> gains(const IndexedStar& star, const StarPoints<Space>& points, Vec3 from, Vec3 target) const;
  /// Returns whether the star's elements are certain to be valid inside with its vertex at `target`.
  [[nodiscard]] bool valid_at(const IndexedStar& star, const StarPoints<Space>& points, Vec3 target) const {
    return first_kernel_.valid_after({star, points.at.data(), target, target});
  }

 private:
  Metric first_;
  PlainComposite aims_;
  VolumeKernel first_kernel_, second_kernel_;
};

/// Kernel for one star. Frame: Plane or Space. The mesh must outlive it.
template <class Frame>
class CompositeStarKernel final : public StarKernel<Frame> {
 public:
  using typename StarKernel<Frame>::Offset;
  using typename StarKernel<Frame>::Found;
  using Star = StarIn<Frame, double>;

  /// Takes an objective whose metrics are all built in: see is_for_kernels().
  CompositeStarKernel(const SmoothingTask& task, const CompositeObjective& objective);

  [[nodiscard]] Found find(PositionView positions, Index vertex, const Untangling& untangling, int levels) const override;
  [[nodiscard]] std::optional<bool> gains(PositionView positions, Index vertex, Vec3 target) const override;
  [[nodiscard]] bool valid_at(Index vertex, Vec3 target) const override;
  [[nodiscard]] std::span<const Index> others(Index vertex) const override { return stars_.of(vertex).vertices; }

  /// Winner of the first levels in a vertex's star, in units of its scale.
  [[nodiscard]] CompositeFound<Frame> search(const Star& star, PositionView positions, Index vertex, int levels) const;

 private:
  struct Room {
    Star star;
    StarPoints<Frame> points;
  };
  static Room& room();

  StarJudge<Frame> judge_;
  CompositeSearch<Frame> aims_;
  CompositeKernel<Frame> kernel_;
  IndexedStars stars_;
  std::optional<CompositeComparison> comparison_;  // none in the plane
};

}  // namespace dmoscope
