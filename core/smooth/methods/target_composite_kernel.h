#pragma once
// Search of single vertices for the mean of the mean ratio against targets: it finds the same as the plain search.

#include <memory>
#include <optional>
#include <vector>

#include "core/smooth/kernels/targets/target_mean_kernel.h"
#include "core/smooth/kernels/targets/tetrahedron_targets.h"
#include "core/smooth/methods/star_points.h"
#include "core/smooth/task.h"
#include "core/smooth/visit/star_judge.h"
#include "core/smooth/visit/star_kernel.h"

namespace dmoscope {

class ThreadPool;

/// Targets of the stars of a planar mesh's vertices, as TargetMeanSearch has them.
class PlanarStarTargets {
 public:
  PlanarStarTargets(const TargetTable& targets, const InputMesh& input, const Colouring& colouring, ThreadPool* pool);
  struct Star {
    const double* numbers = nullptr;
    double doubt = 0.0, stretch = 1.0;  // see TargetMeanSearch
    bool fits = false;                  // else the plain search takes the star
  };
  [[nodiscard]] Star of(Index vertex) const { return stars_[vertex]; }
  [[nodiscard]] bool crossed() const noexcept { return crossed_; }

 private:
  bool crossed_;
  std::vector<std::vector<double>> chunks_;
  std::vector<Star> stars_;  // by vertex
};
/// Targets of the stars of a volume's vertices, whose numbers are gathered at each visit.
class SolidStarTargets {
 public:
  SolidStarTargets(const TargetTable& targets, const InputMesh& input) : targets_(targets, input.mesh), view_(input.view<Space>()) {}
  [[nodiscard]] PlanarStarTargets::Star of(Index vertex) const;
  [[nodiscard]] bool crossed() const noexcept { return targets_.crossed(); }

 private:
  TetrahedronTargets targets_;
  MeshView<Space> view_;
};

/// Kernel for one star. Frame: Plane or Space. The mesh must outlive it.
template <class Frame>
class TargetCompositeKernel final : public StarKernel<Frame> {
 public:
  using typename StarKernel<Frame>::Found;

  /// `objective`: one for which is_for() holds.
  TargetCompositeKernel(const SmoothingTask& task, const CompositeObjective& objective);
  [[nodiscard]] static bool is_for(const SmoothingTask& task, const CompositeObjective& objective);

  [[nodiscard]] Found find(PositionView positions, Index vertex, const Untangling& untangling, int levels) const override;
  [[nodiscard]] std::optional<bool> gains(PositionView positions, Index vertex, Vec3 target) const override;
  [[nodiscard]] bool valid_at(Index /*vertex*/, Vec3 /*target*/) const override { return true; }  // tetrahedra have no inside
  [[nodiscard]] std::span<const Index> others(Index vertex) const override { return stars_.of(vertex).vertices; }

 private:
  struct Room {
    StarIn<Frame, double> star;
    StarPoints<Frame> points;
    TargetMeanSearch<Frame> task;
  };
  static Room& room();

  MeshView<Frame> mesh_;
  TargetMeanSearch<Frame> aims_;
  std::shared_ptr<const DefinedJudge> judge_;
  std::conditional_t<std::is_same_v<Frame, Plane>, PlanarStarTargets, SolidStarTargets> targets_;
  TargetMeanKernel<Frame> kernel_;
  IndexedStars stars_;
};

}  // namespace dmoscope
