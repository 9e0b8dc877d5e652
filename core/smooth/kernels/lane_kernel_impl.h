#pragma once
// The one definition of the lanes' kernel. Only the lane_kernel_*.cpp, each compiled for one kind of processor, include it. Whatever
// runs here must be a template over the packs or always inlined, so that no copy compiled for one processor can be linked into another's
// code; tests/walls.sh looks after that in optimised builds (others inline less).

#include <array>

#include "core/numeric/pack.h"
// After the packs:
#include "core/search/grid_search.h"
#include "core/search/ratio_search.h"
#include "core/smooth/kernels/lane_kernel.h"
#include "core/smooth/kernels/visit_rules.h"

namespace dmoscope::lanes {

/// F: pack of floats, one vertex a slot. D: the pack of doubles, of which it takes one or more for as many vertices.
template <Metric M, class F, class D>
class Kernel {
 public:
  static std::uint64_t run(const LaneTask& task, std::size_t first, std::size_t last) {
    Kernel kernel(task);
    return kernel.visit(first, last);
  }

 private:
  static constexpr std::size_t kWidth = F::size;
  static constexpr std::size_t kHalf = D::size;
  static constexpr std::size_t kMaxPoints = 3 * kMaxQuadrilaterals + 2 * kMaxTriangles;
  static_assert(kMaxPoints > kMaxFan && kMaxFan <= RatioSearch<F>::kMaxForms);
  static_assert(kMaxTriangles + 4 * kMaxQuadrilaterals <= RatioSearch<F>::kMaxForms);
  static constexpr bool kQuadrilaterals = formulas::kDefinedForQuadrilaterals<M, Vec2<F>>;
  static constexpr bool kBlind = visit_rules::kBlind<M, Vec2<F>>;

  template <class R>
  struct Elements {
    std::array<StarTriangle<R>, kMaxFan> triangles;
    std::array<StarQuadrilateral<R>, kQuadrilaterals ? kMaxQuadrilaterals : 1> quadrilaterals;
  };

  explicit Kernel(const LaneTask& task) : task_(task) {}

  std::uint64_t visit(std::size_t first, std::size_t last) {
    std::uint64_t moved = 0;
    count_ = 0;
    for (std::size_t i = first; i < last; ++i) {
      if (i + 2 * kWidth < last && is_awake(i + 2 * kWidth)) prefetch(i + 2 * kWidth);
      if (!is_awake(i)) continue;
      const Index rank = static_cast<Index>(i);
      if (task_.shapes[rank].kind == StarShape::Kind::Alone) {
        moved += visit_alone(rank);
        continue;
      }
      if (count_ > 0 && !alike(rank_[0], rank)) moved += visit_group();
      rank_[count_++] = rank;
      if (count_ == kWidth) moved += visit_group();
    }
    if (count_ > 0) moved += visit_group();
    return moved;
  }

  /// Asks for the memory that the visit of `rank` will read, long before it does.
  void prefetch(std::size_t rank) const {
    for (std::uint32_t i = task_.shapes[rank].first; i < task_.shapes[rank + 1].first; ++i)
      __builtin_prefetch(task_.ranked + 3 * std::size_t{task_.others[i]});
  }

  [[nodiscard]] bool is_awake(std::size_t rank) const { return __atomic_load_n(task_.awake + rank, __ATOMIC_RELAXED) != 0; }
  void set_awake(std::size_t rank, bool awake) const { __atomic_store_n(task_.awake + rank, awake ? 1 : 0, __ATOMIC_RELAXED); }

  /// Do these two fit into one pack?
  [[nodiscard]] bool alike(Index a, Index b) const {
    const StarShape &x = task_.shapes[a], &y = task_.shapes[b];
    return x.kind == y.kind && (x.triangles > 0) == (y.triangles > 0) && (x.quadrilaterals > 0) == (y.quadrilaterals > 0);
  }

  std::uint64_t visit_alone(Index rank) {
    const bool moved = task_.visit_alone(task_.owner, rank);
    if (moved)
      wake_neighbours(rank);
    else
      set_awake(rank, false);
    return moved ? 1 : 0;
  }

  /// Visits rank_[0 .. count_), all alike.
  std::uint64_t visit_group() {
    gather();
    const Candidate<F> found = search();
    const std::uint64_t moved = move(found);
    count_ = 0;
    return moved;
  }

  /// Offsets of the stars' other corners, padded with repeated elements, which change no minimum; slots without a vertex repeat the first.
  void gather() {
    fan_ = task_.shapes[rank_[0]].kind == StarShape::Kind::Fan;
    triangles_ = quadrilaterals_ = 0;
    for (std::size_t slot = 0; slot < count_; ++slot) {
      const StarShape& shape = task_.shapes[rank_[slot]];
      triangles_ = shape.triangles > triangles_ ? shape.triangles : triangles_;
      quadrilaterals_ = shape.quadrilaterals > quadrilaterals_ ? shape.quadrilaterals : quadrilaterals_;
    }
    for (std::size_t slot = 0; slot < kWidth; ++slot) {
      const Index rank = rank_[slot < count_ ? slot : 0];
      if (task_.frame.u_axis >= 0)
        gather_slot<true>(slot, rank);
      else
        gather_slot<false>(slot, rank);
    }
    round_to_float(fan_ ? triangles_ + 1 : 2 * triangles_ + 3 * quadrilaterals_);
  }

  template <bool Axes>
  void gather_slot(std::size_t slot, Index rank) {
    const StarShape& shape = task_.shapes[rank];
    const Index* others = task_.others + shape.first;
    const double* origin = task_.ranked + 3 * std::size_t{rank};
    const std::size_t n = shape.triangles;
    if (fan_) {
      std::size_t from = 0;
      for (std::size_t i = 0; i <= triangles_; ++i) {
        set_point<Axes>(i, slot, others[from], origin);
        if (++from == n) from = 0;
      }
      return;
    }
    for (std::size_t i = 0; i < triangles_; ++i)
      for (std::size_t c = 0; c < 2; ++c) set_point<Axes>(2 * i + c, slot, others[2 * (i < n ? i : 0) + c], origin);
    for (std::size_t i = 0; i < quadrilaterals_; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        set_point<Axes>(2 * triangles_ + 3 * i + c, slot, others[2 * n + 3 * (i < shape.quadrilaterals ? i : 0) + c], origin);
  }

  template <bool Axes>
  void set_point(std::size_t point, std::size_t slot, Index rank, const double* origin) {
    const double* at = task_.ranked + 3 * std::size_t{rank};
    const Vec2<double> offset = task_.frame.offset<Axes>(at, origin);
    exact_x_[point][slot] = offset.x;
    exact_y_[point][slot] = offset.y;
  }

  void round_to_float(std::size_t points) {
    const double inverse = task_.frame.inverse;
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t slot = 0; slot < kWidth; ++slot) x_[i][slot] = static_cast<float>(exact_x_[i][slot] * inverse);
      for (std::size_t slot = 0; slot < kWidth; ++slot) y_[i][slot] = static_cast<float>(exact_y_[i][slot] * inverse);
    }
  }

  [[nodiscard]] Vec2<F> point(std::size_t i) const { return {F::load_aligned(x_[i]), F::load_aligned(y_[i])}; }
  [[nodiscard]] Vec2<D> exact_point(std::size_t i, std::size_t slot) const {
    return {D::load_aligned(exact_x_[i] + slot), D::load_aligned(exact_y_[i] + slot)};
  }

  /// The stars' elements out of their points: at(i) is point i.
  template <class R, class At>
  StarView<R> elements(At at, Elements<R>& out) const {
    if (fan_) {
      for (std::size_t i = 0; i < triangles_; ++i) out.triangles[i] = {at(i), at(i + 1), R(1)};
    } else {
      for (std::size_t i = 0; i < triangles_; ++i) out.triangles[i] = {at(2 * i), at(2 * i + 1), R(1)};
      if constexpr (kQuadrilaterals)
        for (std::size_t i = 0, p = 2 * triangles_; i < quadrilaterals_; ++i, p += 3)
          out.quadrilaterals[i] = {at(p), at(p + 1), at(p + 2), R(1)};
    }
    return {out.triangles.data(), triangles_, out.quadrilaterals.data(), quadrilaterals_};
  }

  /// Width and height of the bounding box of the points.
  [[nodiscard]] Vec2<F> box() const {
    using scalar::max, scalar::min;
    const std::size_t points = fan_ ? triangles_ : 2 * triangles_ + 3 * quadrilaterals_;
    Vec2<F> low = point(0), high = low;
    for (std::size_t i = 1; i < points; ++i) {
      const Vec2<F> p = point(i);
      low = {min(low.x, p.x), min(low.y, p.y)};
      high = {max(high.x, p.x), max(high.y, p.y)};
    }
    return high - low;
  }

  /// The best candidate of every slot; `ready_` tells the slots for which it holds: those whose star floats can hold and whose rank is
  /// not too near to 0, the inverted ones' included. The others are the reference's.
  Candidate<F> search() {
    using scalar::select;
    const StarView<F> star = elements<F>([this](std::size_t i) { return point(i); }, elements_);
    const Objective<M, false, F, Value::Rank> objective(star);
    Vec2<F> size = box();
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

  /// Moves the slots that gain. Judged in double at the very position that will be stored; where two qualities are so close that rounding
  /// could matter, by the statistics' own functions.
  std::uint64_t move(const Candidate<F>& found) {
    alignas(64) float x[kWidth], y[kWidth];
    found.offset.x.store_aligned(x);
    found.offset.y.store_aligned(y);
    bool any = false;
    for (std::size_t slot = 0; slot < kWidth; ++slot) {
      const bool wanted = slot < count_ && ready_[slot] > 0.0F && (x[slot] != 0.0F || y[slot] != 0.0F);
      place(slot, wanted ? x[slot] : 0.0F, wanted ? y[slot] : 0.0F);
      any = any || wanted;
    }
    if (any) judge();
    std::uint64_t moved = 0;
    for (std::size_t slot = 0; slot < count_; ++slot) {
      const Index rank = rank_[slot];
      if (ready_[slot] <= 0.0F) {
        moved += visit_alone(rank);
      } else if (any && gains(slot)) {
        double* to = task_.ranked + 3 * std::size_t{rank};
        for (int i = 0; i < 3; ++i) to[i] = to_[slot].target[i];
        wake_neighbours(rank);
        ++moved;
      } else {
        set_awake(rank, false);
      }
    }
    return moved;
  }

  void place(std::size_t slot, float x, float y) {
    to_[slot] = task_.frame.displace(task_.ranked + 3 * std::size_t{rank_[slot < count_ ? slot : 0]}, x, y);
    step_x_[slot] = to_[slot].step.x;
    step_y_[slot] = to_[slot].step.y;
  }

  void judge() {
    for (std::size_t slot = 0; slot < kWidth; slot += kHalf) {
      Elements<D> scratch;
      const StarView<D> star = elements<D>([this, slot](std::size_t i) { return exact_point(i, slot); }, scratch);
      const Objective<M, false, D, Value::Rank> objective(star);
      objective({D(0.0), D(0.0)}).store_aligned(before_ + slot);
      const Vec2<D> step{D::load_aligned(step_x_ + slot), D::load_aligned(step_y_ + slot)};
      objective(step).store_aligned(after_ + slot);
      const double inverse = task_.frame.inverse;
      if constexpr (kBlind) (visit_rules::smallest_corner(star, step) * D(inverse * inverse)).store_aligned(corner_ + slot);
    }
  }

  [[nodiscard]] bool gains(std::size_t slot) const {
    using visit_rules::Verdict;
    // A metric that does not see a corner turn over says nothing of how near it is to that.
    const bool sound = !kBlind || quadrilaterals_ == 0 || corner_[slot] > visit_rules::kSoundCorner * static_cast<double>(extent2_[slot]);
    const Verdict verdict = visit_rules::judge<M>(before_[slot], after_[slot], to_[slot].step, sound);
    return verdict == Verdict::Move || (verdict == Verdict::MoveIfExact && task_.gains(task_.owner, rank_[slot], to_[slot].target));
  }

  /// Wakes the neighbours of a vertex that moved; it stays awake itself.
  void wake_neighbours(Index rank) {
    const std::uint32_t end = task_.shapes[rank + 1].first;
    for (std::uint32_t i = task_.shapes[rank].first; i < end; ++i) set_awake(task_.others[i], true);
  }

  const LaneTask& task_;
  std::size_t count_ = 0;  // of the group's vertices
  Index rank_[kWidth];
  bool fan_ = false;
  std::size_t triangles_ = 0, quadrilaterals_ = 0;  // the most of any slot
  alignas(64) float x_[kMaxPoints][kWidth], y_[kMaxPoints][kWidth];
  alignas(64) double exact_x_[kMaxPoints][kWidth], exact_y_[kMaxPoints][kWidth];
  alignas(64) float ready_[kWidth];
  alignas(64) double step_x_[kWidth], step_y_[kWidth], before_[kWidth], after_[kWidth];
  alignas(64) double corner_[kWidth];  // kBlind: the smallest Jacobian after the move, in units of scale^2
  alignas(64) float extent2_[kWidth];  // kBlind: the square of the star's extent, likewise
  Displacement to_[kWidth];
  Elements<F> elements_;
  std::array<RatioForm<F>, RatioSearch<F>::kMaxForms> forms_;
  RatioSearch<F> rounds_;
};

/// The kernel for `metric` with this translation unit's widest packs.
template <class F, class D>
LaneKernel kernel_for(Metric metric) {
  return formulas::with_planar_metric(metric, []<Metric M>() -> LaneKernel { return &Kernel<M, F, D>::run; });
}

}  // namespace dmoscope::lanes
