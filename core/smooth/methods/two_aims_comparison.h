#pragma once
// Whether a move gains by two aims, where rounding does not decide.

#include <optional>

#include "core/numeric/simd.h"
#include "core/smooth/methods/star_points.h"
#include "core/smooth/two_aims.h"

namespace dmoscope {

/// Does a vertex gain, as gains_by_two() has it where no element is inverted? Nothing where that has to say. `first`: the least first
/// metric. second(): the second aim. Both found by the search's formulas; where the star is not certain to be sound, 0.
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

/// In a volume, by the kernels.
class TwoAimsComparison {
 public:
  /// `aims`: of two metrics, or of the mean.
  TwoAimsComparison(SimdLevel level, Metric first, const Aims& aims);

  /// Would the star's vertex gain by going to `target`? See gains_for_certain().
  [[nodiscard]] std::optional<bool> gains(const IndexedStar& star, const StarPoints<Space>& points, Vec3 from, Vec3 target) const;
  /// Are the star's elements certain to be valid inside with its vertex at `target`?
  [[nodiscard]] bool valid_at(const IndexedStar& star, const StarPoints<Space>& points, Vec3 target) const {
    return first_kernel_.valid_after({star, points.at.data(), target, target});
  }

 private:
  Metric first_;
  Aims aims_;
  VolumeKernel first_kernel_, second_kernel_;
};

}  // namespace dmoscope
