#pragma once
// Sole definition of the lanes' kernel. Only the kernel_set_*.cpp, each compiled for one kind of processor, include it. Whatever runs here
// must be a template over the packs or always inlined, so that no copy compiled for one processor can be linked into another's code;
// tests/walls.sh looks after that in optimised builds (others inline less).

#include <array>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/ratio_search.h"
#include "core/smooth/kernels/lane_group.h"

namespace dmoscope::lanes {

/// Kernel by a built-in metric.
template <Metric M, class F, class D>
class Kernel : LaneGroup<Kernel<M, F, D>, formulas::kDefinedForQuadrilaterals<M, Vec2<F>>, F, D> {
 public:
  static std::uint64_t run(const LaneTask& task, std::size_t first, std::size_t last) {
    Kernel kernel(task);
    return kernel.visit(first, last);
  }

 private:
  static constexpr bool kQuadrilaterals = formulas::kDefinedForQuadrilaterals<M, Vec2<F>>;
  static constexpr bool kBlind = visit_rules::kBlind<M, Vec2<F>>;
  using Base = LaneGroup<Kernel, kQuadrilaterals, F, D>;
  friend Base;
  using Base::after_, Base::before_, Base::exact_point, Base::point, Base::quadrilaterals_, Base::ready_, Base::step_x_, Base::step_y_,
      Base::task_, Base::to_;
  using Base::kHalf, Base::kWidth;
  static_assert(kMaxFan <= RatioSearch<F>::kMaxForms);
  static_assert(kMaxTriangles + 4 * kMaxQuadrilaterals <= RatioSearch<F>::kMaxForms);

  explicit Kernel(const LaneTask& task) : Base(task) {}

  void gather_targets(std::size_t /*slot*/, Index /*rank*/) const {}

  /// Best candidate of every slot; `ready_` tells the slots for which it is valid: those whose star floats can hold and whose rank is not
  /// too near to 0, the inverted ones' included. The reference visits the others.
  Candidate<F> search() {
    using scalar::select;
    const StarView<F> star = this->template elements<F>([this](std::size_t i) { return point(i); }, elements_);
    const Objective<M, false, F, Value::Rank> objective(star);
    Vec2<F> size = this->box();
    const F extent = size.x + size.y;
    auto ready = (objective({F(0.0F), F(0.0F)}) > F(visit_rules::kLeastRank)) & (extent > F(visit_rules::kSmallestExtent)) &
                 (extent < F(task_.frame.largest_extent));
    if constexpr (kBlind)
      ready = ready & (visit_rules::smallest_corner(star, {F(0.0F), F(0.0F)}) > F(visit_rules::kLeastCorner) * extent * extent);
    size = {select(ready, size.x, F(0.0F)), select(ready, size.y, F(0.0F))};
    select(ready, F(1.0F), F(0.0F)).store_aligned(ready_);
    if constexpr (kBlind) (extent * extent).store_aligned(extent2_);
    const SearchParameters& parameters = task_.parameters;
    if constexpr (kIsRatio<M>)
      if (parameters.grid_points == RatioSearch<F>::kPoints) return search_by_rounds(star, size);
    return grid_search<F>(objective, size, parameters);
  }

  Candidate<F> search_by_rounds(const StarView<F>& star, Vec2<F> size) {
    using scalar::min;
    std::size_t count = 0;
    F cap = scalar::constant<F>(1e30);
    for (const StarTriangle<F>& t : star.triangles()) triangle_form(t, forms_[count++]);
    if constexpr (kQuadrilaterals) {
      for (const StarQuadrilateral<F>& q : star.quadrilaterals()) {
        cap = min(cap, quadrilateral_forms<M>(q, forms_.data() + count));
        count += kQuadrilateralForms<M>;
      }
    }
    return rounds_.search({forms_.data(), count}, cap, size, task_.parameters.levels, task_.parameters.omega);
  }

  void judge() {
    for (std::size_t slot = 0; slot < kWidth; slot += kHalf) {
      Elements<D, kQuadrilaterals> scratch;
      const StarView<D> star = this->template elements<D>([this, slot](std::size_t i) { return exact_point(i, slot); }, scratch);
      const Objective<M, false, D, Value::Rank> objective(star);
      objective({D(0.0), D(0.0)}).store_aligned(before_ + slot);
      const Vec2<D> step{D::load_aligned(step_x_ + slot), D::load_aligned(step_y_ + slot)};
      objective(step).store_aligned(after_ + slot);
      const double inverse = task_.frame.inverse;
      if constexpr (kBlind) (visit_rules::smallest_corner(star, step) * D(inverse * inverse)).store_aligned(corner_ + slot);
    }
  }

  [[nodiscard]] visit_rules::Verdict verdict(std::size_t slot) const {
    // Requires sound corners of a metric that does not see a corner turn over: it does not tell how near it is to that.
    const bool sound = !kBlind || quadrilaterals_ == 0 || corner_[slot] > visit_rules::kSoundCorner * static_cast<double>(extent2_[slot]);
    return visit_rules::judge<M>(before_[slot], after_[slot], to_[slot].step, sound);
  }

  alignas(64) double corner_[kWidth];  // kBlind: the smallest Jacobian after the move, in units of scale^2
  alignas(64) float extent2_[kWidth];  // kBlind: the square of the star's extent, in units of scale^2
  Elements<F, kQuadrilaterals> elements_;
  std::array<RatioForm<F>, RatioSearch<F>::kMaxForms> forms_;
  RatioSearch<F> rounds_;
};

/// Kernel for `metric` with this translation unit's widest packs.
template <class F, class D>
LaneKernel kernel_for(Metric metric) {
  return formulas::with_planar_metric(metric, []<Metric M>() -> LaneKernel { return &Kernel<M, F, D>::run; });
}

}  // namespace dmoscope::lanes
