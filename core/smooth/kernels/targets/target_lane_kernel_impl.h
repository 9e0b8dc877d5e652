#pragma once
// Sole definition of the lanes' kernel for meshes whose elements have targets. Only the kernel_set_*.cpp include it; see lane_kernel_impl.h
// for what that asks of the code.

#include <array>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/ratio_search.h"
#include "core/smooth/kernels/lane_group.h"
#include "core/smooth/kernels/targets/target_star.h"

namespace dmoscope::lanes {

/// Kernel by the mean ratio.
template <bool Crossed, class F, class D>
class TargetKernel : LaneGroup<TargetKernel<Crossed, F, D>, true, F, D> {
 public:
  static std::uint64_t run(const LaneTask& task, std::size_t first, std::size_t last) {
    TargetKernel kernel(task);
    return kernel.visit(first, last);
  }

 private:
  using Base = LaneGroup<TargetKernel, true, F, D>;
  friend Base;
  using Base::after_, Base::before_, Base::exact_point, Base::fan_, Base::point, Base::quadrilaterals_, Base::ready_, Base::step_x_,
      Base::step_y_, Base::task_, Base::to_, Base::triangles_;
  using Base::kHalf, Base::kWidth;
  using Rounds = RatioSearch<F, 0, Tables::Full, Solo, TargetForm<F, Crossed>>;
  static constexpr std::size_t kNumbers = target_numbers(Crossed);
  static_assert(target_star::kMaxForms <= Rounds::kMaxForms);

  explicit TargetKernel(const LaneTask& task) : Base(task) {}

  /// Gathers targets in the order of the elements of LaneGroup::gather_slot: padded with repeated ones.
  void gather_targets(std::size_t slot, Index rank) {
    const StarShape& shape = task_.shapes[rank];
    const double* from = task_.targets + kNumbers * std::size_t{task_.first_target[rank]};
    std::size_t to = 0;
    const auto take = [&](std::size_t target) {
      for (std::size_t k = 0; k < kNumbers; ++k) exact_targets_[to][k][slot] = from[kNumbers * target + k];
      ++to;
    };
    const std::size_t n = shape.triangles;
    for (std::size_t i = 0, at = 0; i < triangles_; ++i) {
      take(at);
      if (++at == n) at = 0;
      if (!fan_ && i + 1 >= n) at = 0;
    }
    for (std::size_t i = 0; i < quadrilaterals_; ++i)
      for (std::size_t c = 0; c < kQuadrilateralTargets; ++c) take(n + kQuadrilateralTargets * (i < shape.quadrilaterals ? i : 0) + c);
  }

  [[nodiscard]] CornerTarget<F> target(std::size_t i) const {
    return corner_target<Crossed, F>([&](std::size_t k) { return F::load_aligned(targets_[i][k]); });
  }
  [[nodiscard]] CornerTarget<D> exact_target(std::size_t i, std::size_t slot) const {
    return corner_target<Crossed, D>([&](std::size_t k) { return D::load_aligned(exact_targets_[i][k] + slot); });
  }
  [[nodiscard]] std::size_t target_count() const { return triangles_ + kQuadrilateralTargets * quadrilaterals_; }

  Candidate<F> search() {
    using scalar::select;
    for (std::size_t i = 0; i < target_count(); ++i)
      for (std::size_t k = 0; k < kNumbers; ++k)
        for (std::size_t slot = 0; slot < kWidth; ++slot) targets_[i][k][slot] = static_cast<float>(exact_targets_[i][k][slot]);
    const StarView<F> star = this->template elements<F>([this](std::size_t i) { return point(i); }, elements_);
    std::size_t count = 0;
    F cap(0.0F);
    Vec2<F> size = this->box();
    const F extent = size.x + size.y;
    const auto sound = target_star::take_forms<Crossed>(
        star, [this](std::size_t i) { return target(i); }, forms_.data(), count, cap);
    const auto ready = sound & (extent > F(visit_rules::kSmallestExtent)) & (extent < F(task_.frame.largest_extent));
    size = {select(ready, size.x, F(0.0F)), select(ready, size.y, F(0.0F))};
    select(ready, F(1.0F), F(0.0F)).store_aligned(ready_);
    return rounds_.search({forms_.data(), count}, cap, size, task_.parameters.levels, task_.parameters.omega);
  }

  void judge() {
    using scalar::max;
    for (std::size_t slot = 0; slot < kWidth; slot += kHalf) {
      Elements<D, true> scratch;
      const StarView<D> star = this->template elements<D>([this, slot](std::size_t i) { return exact_point(i, slot); }, scratch);
      const auto at = [this, slot](std::size_t i) { return exact_target(i, slot); };
      target_star::quality<Crossed>(star, {D(0.0), D(0.0)}, at).store_aligned(before_ + slot);
      const Vec2<D> step{D::load_aligned(step_x_ + slot), D::load_aligned(step_y_ + slot)};
      target_star::quality<Crossed>(star, step, at).store_aligned(after_ + slot);
      D room(0.0);
      for (std::size_t i = 0; i < target_count(); ++i) room = max(room, target_star::doubt(exact_target(i, slot)));
      room.store_aligned(room_ + slot);
    }
  }

  [[nodiscard]] visit_rules::Verdict verdict(std::size_t slot) const {
    return target_star::judge(before_[slot], after_[slot], room_[slot], to_[slot].step);
  }

  alignas(64) double exact_targets_[target_star::kMaxTargets][kNumbers][kWidth];
  alignas(64) float targets_[target_star::kMaxTargets][kNumbers][kWidth];
  alignas(64) double room_[kWidth];  // room for rounding
  Elements<F, true> elements_;
  std::array<TargetForm<F, Crossed>, target_star::kMaxForms> forms_;
  Rounds rounds_;
};

/// Kernel with this translation unit's widest packs.
template <class F, class D>
LaneKernel target_kernel_for(bool crossed) {
  return crossed ? &TargetKernel<true, F, D>::run : &TargetKernel<false, F, D>::run;
}

}  // namespace dmoscope::lanes
