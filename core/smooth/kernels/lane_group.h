#pragma once
// Common part of all kernels for lanes: gathers stars, one vertex a slot of a pack, and moves the vertices that gain. Only the kernels' own
// headers include it; see lane_kernel_impl.h for what that asks of the code.

#include <array>
#include <limits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/grid_search.h"
#include "core/search/star.h"
#include "core/smooth/kernels/lane_kernel.h"
#include "core/smooth/kernels/visit_rules.h"

namespace dmoscope::lanes {

/// Elements of a group of stars. Real: a pack.
template <class R, bool Quadrilaterals>
struct Elements {
  std::array<StarTriangle<R>, kMaxFan> triangles;
  std::array<StarQuadrilateral<R>, Quadrilaterals ? kMaxQuadrilaterals : 1> quadrilaterals;
};

/// Group of vertices that are visited together. F: pack of floats, one vertex a slot. D: pack of doubles, one or more for as many vertices.
/// Kernel, which derives from it, has:
/// - gather_targets(slot, rank): reads targets or other data of a vertex;
/// - search(): the best candidate of every slot; it sets `ready_` for the slots for which that is valid;
/// - judge(): compares the places in to_ with the vertices' positions;
/// - verdict(slot): the verdict that follows from that.
template <class Kernel, bool Quadrilaterals, class F, class D>
class LaneGroup {
 protected:
  static constexpr std::size_t kWidth = F::size;
  static constexpr std::size_t kHalf = D::size;
  static constexpr std::size_t kMaxPoints = 3 * kMaxQuadrilaterals + 2 * kMaxTriangles;
  static_assert(kMaxPoints > kMaxFan);

  explicit LaneGroup(const LaneTask& task) : task_(task) {}

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

  /// Returns whether two stars fit into one pack.
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

  /// Visits rank_[0 .. count_), whose stars fit into one pack.
  std::uint64_t visit_group() {
    gather();
    const Candidate<F> found = kernel().search();
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
      kernel().gather_targets(slot, rank);
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

  /// Elements of the stars, made of their points: at(i) is point i.
  template <class R, class At>
  StarView<R> elements(At at, Elements<R, Quadrilaterals>& out) const {
    if (fan_) {
      for (std::size_t i = 0; i < triangles_; ++i) out.triangles[i] = {at(i), at(i + 1), R(1)};
    } else {
      for (std::size_t i = 0; i < triangles_; ++i) out.triangles[i] = {at(2 * i), at(2 * i + 1), R(1)};
      if constexpr (Quadrilaterals)
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
    if (any) kernel().judge();
    if (any && is_guarded()) judge_guard();
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

  [[nodiscard]] bool gains(std::size_t slot) {
    using visit_rules::Verdict;
    const Verdict verdict = kernel().verdict(slot);
    if (verdict == Verdict::Move && (!is_guarded() || guard_[slot] > task_.guarded_above)) return true;
    return verdict != Verdict::Stay && task_.gains(task_.owner, rank_[slot], to_[slot].target);
  }

  [[nodiscard]] bool is_guarded() const { return task_.guarded_above > -std::numeric_limits<double>::infinity(); }
  /// Finds the least mean ratio of each star after its step.
  void judge_guard() {
    for (std::size_t slot = 0; slot < kWidth; slot += kHalf) {
      Elements<D, Quadrilaterals> scratch;
      const Objective<Metric::MeanRatio, false, D, Value::Rank> least(
          elements<D>([this, slot](std::size_t i) { return exact_point(i, slot); }, scratch));
      least({D::load_aligned(step_x_ + slot), D::load_aligned(step_y_ + slot)}).store_aligned(guard_ + slot);
    }
  }

  /// Wakes the neighbours of a vertex that moved; it stays awake itself.
  void wake_neighbours(Index rank) {
    const std::uint32_t end = task_.shapes[rank + 1].first;
    for (std::uint32_t i = task_.shapes[rank].first; i < end; ++i) set_awake(task_.others[i], true);
  }

  [[nodiscard]] Kernel& kernel() { return static_cast<Kernel&>(*this); }

  const LaneTask& task_;
  std::size_t count_ = 0;  // number of vertices in the group
  Index rank_[kWidth];
  bool fan_ = false;
  std::size_t triangles_ = 0, quadrilaterals_ = 0;  // most of any slot
  alignas(64) float x_[kMaxPoints][kWidth], y_[kMaxPoints][kWidth];
  alignas(64) double exact_x_[kMaxPoints][kWidth], exact_y_[kMaxPoints][kWidth];
  alignas(64) float ready_[kWidth];
  alignas(64) double step_x_[kWidth], step_y_[kWidth], before_[kWidth], after_[kWidth], guard_[kWidth];
  Displacement to_[kWidth];
};

}  // namespace dmoscope::lanes
