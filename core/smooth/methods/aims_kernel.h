#pragma once
// The grid search for two aims by packs of candidates, in double: it finds what the plain search finds.

#include <optional>

#include "core/smooth/methods/two_aims_comparison.h"
#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/star_kernel.h"

namespace dmoscope {

/// Frame: Plane or Space. The mesh must outlive it.
template <class Frame>
class AimsKernel final : public StarKernel<Frame> {
 public:
  using typename StarKernel<Frame>::Offset;
  using typename StarKernel<Frame>::Found;
  using Star = StarIn<Frame, double>;

  /// All metrics of the objective must be built in: see is_for_kernels().
  AimsKernel(const SmoothingTask& task, const CompositeObjective& objective);

  [[nodiscard]] Found find(PositionView positions, Index vertex, const Untangling& untangling) const override;
  [[nodiscard]] std::optional<bool> gains(PositionView positions, Index vertex, Vec3 target) const override;
  [[nodiscard]] bool valid_at(Index vertex, Vec3 target) const override;
  [[nodiscard]] std::span<const Index> others(Index vertex) const override { return stars_.of(vertex).vertices; }

  /// The winner of a vertex's star, in units of its scale.
  [[nodiscard]] CompositeFound<Frame> search(const Star& star, PositionView positions, Index vertex) const;

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
  std::optional<TwoAimsComparison> comparison_;  // in space
};

}  // namespace dmoscope
