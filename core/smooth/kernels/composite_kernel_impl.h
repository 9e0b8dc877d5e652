#pragma once
// Sole definition of the kernel for two aims. Only the kernel_set_*.cpp, each compiled for one kind of processor, include it; see
// lane_kernel_impl.h for what that asks of the code.

#include <array>
#include <limits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/grid_search.h"
#include "core/smooth/kernels/composite_kernel.h"
#include "core/smooth/kernels/composite_metrics.h"
#include "core/smooth/kernels/planar_cuts.h"
#include "core/smooth/kernels/ratio_bounds.h"

namespace dmoscope::composite {

/// Kernel of one search. M: the first metric; D: pack of doubles, a candidate per slot.
template <Metric M, class Frame, class D>
class Kernel {
 public:
  static CompositeFound<Frame> run(const CompositeSearch<Frame>& task) {
    if (!has_room(task) || task.points > kMaxCompositePoints) return {};
    Kernel kernel(task);
    return kernel.search();
  }
  static CompositeBest run_list(const CompositeSearch<Frame>& task, const CompositeCandidates& candidates, double best) {
    if (!has_room(task) || !(best > 0.0)) return {};
    Kernel kernel(task);
    return kernel.best_of(candidates, best);
  }

 private:
  using Task = CompositeSearch<Frame>;
  using Second = typename Task::Second;
  using Point = OffsetIn<Frame, D>;
  static constexpr bool kSpace = std::is_same_v<Frame, Space>;
  using F = Pack<float>;
  static constexpr std::size_t kWidth = D::size, kFloats = F::size;
  static constexpr std::size_t kMaxPoints = kMaxCompositePoints;
  static constexpr std::size_t kMaxPlane = kMaxPoints * kMaxPoints + kFloats;
  static constexpr bool kBounded = !std::is_same_v<Frame, Curved> && M == Metric::MeanRatio;
  static constexpr bool kCut = std::is_same_v<Frame, Plane> && M == Metric::MeanRatio;
  /// Returns whether bounds pay. In the plane an exact look costs little more than a bound: only where the mean is raised, too, bounds pay.
  /// With the second metric judged first, mostly a few elements tell as much.
  [[nodiscard]] bool is_bounded() const { return task_.second == Second::Mean || (kSpace && !is_by_second()); }
  /// Returns whether a place can win only by its second metric.
  [[nodiscard]] bool is_by_second() const { return second_metric_ != nullptr && best_ > task_.threshold; }

  [[nodiscard]] static bool is_guarded(const Task& task) { return task.guard_below > -std::numeric_limits<double>::infinity(); }
  [[nodiscard]] static SecondMetric<Frame, D> second_metric_of(Metric metric) {
    return with_metric_of<Frame>(metric, []<Metric Other>() -> SecondMetric<Frame, D> { return &second_metric<Other, Frame, D>; });
  }

  static bool has_room(const Task& task) {
    std::size_t others = 0;
    task.star.for_others([&others](const auto&) { ++others; });
    return task.star.simplices.size <= kMaxSimplices && others <= kMaxOthers;
  }

  explicit Kernel(const Task& task)
      : task_(task),
        first_(task.star.simplices.size, task.second == Second::Mean),
        second_(task.star.simplices.size, false),
        guard_(is_guarded(task) ? task.star.simplices.size : 0, false) {
    if (is_guarded(task)) guard_metric_ = second_metric_of(task.guarded);
    if (task.second == Second::Metric) {
      second_metric_ = second_metric_of(task.metric);
      second_rank_ = with_metric_of<Frame>(task.metric, []<Metric Other>() { return second_rank<Other, Frame, D>(); });
    }
    if constexpr (formulas::kSignTellsInversion<M, Point> && formulas::kDefinedForOthers<M, Point>)
      if (first_.keeps_others) find_elsewhere<M, Frame>(task.star, first_);
  }

  CompositeFound<Frame> search() {
    const auto n = static_cast<std::size_t>(task_.points);
    for (std::size_t i = 0; i < n; ++i) part_[i] = static_cast<double>(i) / static_cast<double>(n - 1) - 0.5;
    if constexpr (kCut) {
      if (PlanarCuts<F>::speaks_for(task_)) return search_by_cuts();
    }
    CompositeFound<Frame> found;
    best_ = worth(Point{}, D(-1.0)).get(0);
    found.ready = best_ > 0.0;
    if (!found.ready) return found;
    take_bounds();
    note_second();
    double omega = task_.omega;
    for (int level = 0; level < task_.levels; ++level) {
      search_level(omega);
      omega *= 2.0 / (task_.points - 1);
    }
    found.offset = best_place();
    return found;
  }
  /// Searches in the plane with an exact look only where the cuts do not tell for certain which candidate of a level is best.
  CompositeFound<Frame> search_by_cuts() {
    constexpr std::size_t kStride = PlanarCuts<F>::kStride;
    const auto n = static_cast<std::size_t>(task_.points);
    double x[kStride], y[kStride], omega = task_.omega;
    cuts_.take(task_);
    bool is_known = false;  // whether best_ is known
    for (int level = 0; level < task_.levels; ++level, omega *= 2.0 / (task_.points - 1)) {
      for (std::size_t i = 0; i < n; ++i) {  // numbered as in CandidateGrid
        x[i] = at_[0] + task_.box.x * omega * part_[i];
        y[i] = at_[1] + task_.box.y * omega * part_[i];
      }
      const auto side = cuts_.begin({at_[0], at_[1]}, x, y);
      if (!is_known && side == PlanarCuts<F>::Side::Unsure) {
        if (!look_at_best()) return {};
        is_known = true;
      }
      auto [hopeful, has_winner] = cuts_.search(is_known ? best_ > task_.threshold : side == PlanarCuts<F>::Side::Beyond);
      if (has_winner) {
        const auto bit = static_cast<std::size_t>(__builtin_ctzll(hopeful));
        at_[0] = x[bit / kStride];
        at_[1] = y[bit % kStride];
        is_known = false;
      } else if (hopeful != 0) {
        if (!is_known && !look_at_best()) return {};
        is_known = true;
        note_second();
        look_at_bits(hopeful, x, y);
      }
    }
    return {true, best_place()};
  }
  /// Evaluates the best place so far. Returns whether the star is sound there.
  bool look_at_best() {
    best_ = least_second_ = 0.0;
    best_ = worth(point_of<D>(best_place()), D(-1.0)).get(0);
    return best_ > 0.0;
  }
  /// Looks at some candidates of a planar grid (PlanarCuts::Candidates), in the order of their indices.
  void look_at_bits(std::uint64_t hopeful, const double* x, const double* y) {
    while (hopeful != 0) {
      for (std::size_t k = 0; k < kWidth; ++k) {  // repeats the last, which cannot be better than itself
        const auto bit = static_cast<std::size_t>(__builtin_ctzll(hopeful));
        if (k + 1 == kWidth || (hopeful & (hopeful - 1)) != 0) hopeful &= hopeful - 1;
        plane_[0][k] = x[bit / PlanarCuts<F>::kStride];
        plane_[1][k] = y[bit % PlanarCuts<F>::kStride];
      }
      look_at(0, 0.0);
    }
  }
  [[nodiscard]] OffsetIn<Frame, double> best_place() const {
    if constexpr (kSpace)
      return {at_[2], at_[0], at_[1]};
    else if constexpr (std::is_same_v<Frame, Plane>)
      return {at_[0], at_[1]};
    else
      return {};  // curved surfaces are searched by lists alone
  }
  /// Notes, where the best place is beyond the threshold, the rank of its second metric: no place of lower rank is better.
  void note_second() {
    if constexpr (!std::is_same_v<Frame, Curved>) {
      constexpr double kLeastCertain = 1e-4;  // see formulas::rank_doubt
      if (second_rank_.least == nullptr || !(best_ > task_.threshold)) return;
      const double rank = second_rank_.least(task_.star, point_of<D>(best_place()), second_, -1.0).get(0);
      least_second_ = rank > kLeastCertain ? rank - 2.0 * second_rank_.doubt(rank) : 0.0;
    }
  }

  CompositeBest best_of(const CompositeCandidates& candidates, double best) {
    best_ = best;
    CompositeBest found{true, candidates.count, best};
    const auto look = [&](std::size_t c) {
      const auto along = [&](std::size_t axis) { return D::load_unaligned(candidates.at[axis] + c); };
      Point p;
      if constexpr (std::is_same_v<Frame, Plane>)
        p = {along(0), along(1)};
      else if constexpr (kSpace)
        p = {along(0), along(1), along(2)};
      else
        p.v = {along(0), along(1), along(2)};
      D value = worth(p, D(best_));
      if (guard_metric_ != nullptr && xsimd::any(value > D(best_))) {
        const D below(task_.guard_below);
        value = xsimd::select(guard_metric_(task_.star, p, guard_, D(0.0), below) > below, value, D(best_));
      }
      if (!xsimd::any(value > D(best_))) return false;
      alignas(64) double values[kWidth];
      value.store_aligned(values);
      for (std::size_t k = 0; k < kWidth; ++k)
        if (values[k] > best_) best_ = values[k], found = {true, c + k, best_};
      return true;
    };
    if constexpr (kBounded) {
      if (is_bounded()) {
        look_at_hopeful(candidates, look);
        return found;
      }
    }
    for (std::size_t c = 0; c < candidates.count; c += kWidth) look(c);
    return found;
  }

  /// Calls look(c) for each pack of doubles that may win by its bounds; look returns whether a candidate won.
  template <class Look>
  void look_at_hopeful(const CompositeCandidates& candidates, const Look& look) {
    constexpr std::size_t kAxes = kSpace ? 3 : 2;
    std::array<double, 3> centre{}, half{};
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      double low = candidates.count > 0 ? candidates.at[axis][0] : 0.0, high = low;
      for (std::size_t i = 1; i < candidates.count; ++i) {
        const double at = candidates.at[axis][i];
        low = at < low ? at : low;
        high = at > high ? at : high;
      }
      centre[axis] = 0.5 * (low + high), half[axis] = 0.5 * (high - low);
    }
    take_bounds();
    move_bounds_to(centre, half);
    for (std::size_t c = 0; c < candidates.count; c += kFloats) {
      alignas(64) float from_centre[kAxes][kFloats];
      for (std::size_t axis = 0; axis < kAxes; ++axis)
        for (std::size_t k = 0; k < kFloats; ++k) from_centre[axis][k] = static_cast<float>(candidates.at[axis][c + k] - centre[axis]);
      OffsetIn<Frame, F> d{F::load_aligned(from_centre[0]), F::load_aligned(from_centre[1])};
      if constexpr (kSpace) d.z = F::load_aligned(from_centre[2]);
      look_where_hopeful(d, [&](std::size_t k) { return c + k < candidates.count && look(c + k); });
    }
  }

  [[nodiscard]] auto beyond(D least) const {
    const D threshold(task_.threshold);
    return task_.inclusive ? (least > D(0.0)) & (least >= threshold) : least > threshold;
  }

  /// Score of each of the places, as CompositeScore has it; in a slot that is not above `best`, which is positive or below all, any number
  /// that is not either.
  D worth(const Point& p, D best) {
    if (least_second_ > 0.0 && !xsimd::any(second_rank_.least(task_.star, p, second_, least_second_) > D(least_second_))) return best;
    // Judges the second metric first where places can win only by it: mostly a few elements tell.
    const bool by_second = is_by_second();
    const D second = by_second ? second_metric_(task_.star, p, second_, D(task_.threshold), best) : best;
    if (by_second && !xsimd::any(second > best)) return best;
    const D least = least_at<M, Frame, D>(task_.star, p, first_, [&](D so_far) { return xsimd::any((so_far > best) | beyond(so_far)); });
    const auto is_beyond = beyond(least);
    if (!xsimd::any(is_beyond)) return least;
    return xsimd::select(is_beyond, by_second ? second : worth_beyond(p, best), least);
  }
  D worth_beyond(const Point& p, D best) {
    const D threshold(task_.threshold);
    if (task_.second == Second::Metric) return second_metric_(task_.star, p, second_, threshold, best);
    if (task_.second == Second::Mean) return threshold + mean(p);
    if constexpr (!std::is_same_v<Frame, Curved>) {  // sizes are for planar meshes
      if (!(task_.edge > 0.0)) return threshold;
      const Point away = p - point_of<D>(task_.wanted);
      return threshold + D(1.0) / (D(1.0) + dot(away, away) / D(task_.edge * task_.edge));
    }
    return threshold;
  }
  /// Mean over all elements, whose qualities were found just before.
  [[nodiscard]] D mean(const Point& p) const {
    const std::size_t simplices = task_.star.simplices.size;
    PowerMean<D> mean(task_.mean);
    for (std::size_t i = 0; i < simplices; ++i) mean.add(first_.quality[i]);
    std::size_t others = 0;
    if constexpr (formulas::kDefinedForOthers<M, Point>) {
      task_.star.for_others([&](const auto& element) {
        // Evaluates blind metrics anew, for which Objective keeps no qualities.
        mean.add(formulas::kSignTellsInversion<M, Point> ? first_.others[others] : formulas::metric<M>(element.with(p)));
        ++others;
      });
    }
    return mean.value(static_cast<double>(simplices + others));
  }

  /// Sets the candidates of a level along its last two axes, in the order of their indices: as CandidateGrid has them.
  void set_plane(double width0, double width1) {
    const double centre0 = at_[0], centre1 = at_[1];
    const auto n = static_cast<std::size_t>(task_.points);
    std::size_t c = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double first = centre0 + width0 * part_[i];
      for (std::size_t j = 0; j < n; ++j, ++c) {
        plane_[0][c] = first;
        plane_[1][c] = centre1 + width1 * part_[j];
      }
    }
    for (; c % kFloats != 0; ++c) {  // repeats the last, which cannot be better than itself
      plane_[0][c] = plane_[0][n * n - 1];
      plane_[1][c] = plane_[1][n * n - 1];
    }
    if constexpr (kBounded) {
      if (!is_bounded()) return;
      for (std::size_t i = 0; i < c; ++i) {
        from_centre_[0][i] = static_cast<float>(plane_[0][i] - centre0);
        from_centre_[1][i] = static_cast<float>(plane_[1][i] - centre1);
      }
    }
  }

  void search_level(double omega) {
    const double half = 0.5 * omega;
    if constexpr (kSpace) {
      const double centre = at_[2], width = task_.box.x * omega;
      set_plane(task_.box.y * omega, task_.box.z * omega);
      move_bounds_to({at_[2], at_[0], at_[1]}, {half * task_.box.x, half * task_.box.y, half * task_.box.z});
      for (std::size_t i = 0; i < static_cast<std::size_t>(task_.points); ++i) {
        const double x = centre + width * part_[i];
        search_plane(x, static_cast<float>(x - centre));
      }
    } else {
      set_plane(task_.box.x * omega, task_.box.y * omega);
      move_bounds_to({at_[0], at_[1], 0.0}, {half * task_.box.x, half * task_.box.y, 0.0});
      search_plane(0.0, 0.0F);
    }
  }

  void move_bounds_to(const std::array<double, 3>& centre, const std::array<double, 3>& half) {
    if constexpr (kBounded) {
      if (!is_bounded()) return;
      bounds_.move_to(centre, half);
      set_needs();
    }
  }
  void take_bounds() {
    if constexpr (kBounded) {
      if (is_bounded()) bounds_.take(task_.star, task_.mean, kSpace && first_.keeps_others ? first_.elsewhere.data() : nullptr);
    }
  }
  /// Sets what a candidate must reach to win.
  void set_needs() {
    const bool is_beyond = best_ >= task_.threshold;
    const bool by_mean = is_beyond && task_.second == Second::Mean;
    bounds_.set_needs(is_beyond ? task_.threshold : best_, by_mean ? best_ - task_.threshold : 0.0);
  }

  /// Calls look(k) for each pack of doubles, among those in a pack of floats, that may win by its bounds; look returns whether a candidate
  /// won.
  template <class Look>
  void look_where_hopeful(const OffsetIn<Frame, F>& from_centre, const Look& look) {
    const auto hope = bounds_.may_reach(from_centre);
    if (!xsimd::any(hope)) return;
    alignas(64) float hopeful[kFloats];
    xsimd::select(hope, F(1.0F), F(0.0F)).store_aligned(hopeful);
    for (std::size_t k = 0; k < kFloats; k += kWidth) {
      bool any = false;
      for (std::size_t i = k; i < k + kWidth; ++i) any = any || hopeful[i] > 0.0F;
      if (any && look(k)) set_needs();
    }
  }

  /// Evaluates the candidates of a plane that may win. `x`: in space, the first coordinate of all of them; `from_centre`: the same
  /// coordinate from the grid's centre.
  void search_plane(double x, [[maybe_unused]] float from_centre) {
    const std::size_t candidates = static_cast<std::size_t>(task_.points) * static_cast<std::size_t>(task_.points);
    if constexpr (kBounded) {
      if (is_bounded()) {
        for (std::size_t c = 0; c < candidates; c += kFloats) {
          const F first = F::load_aligned(from_centre_[0] + c), second = F::load_aligned(from_centre_[1] + c);
          OffsetIn<Frame, F> d{first, second};
          if constexpr (kSpace) d = {F(from_centre), first, second};
          look_where_hopeful(d, [&](std::size_t k) { return look_at(c + k, x); });
        }
        return;
      }
    }
    for (std::size_t c = 0; c < candidates; c += kWidth) look_at(c, x);
  }
  /// Evaluates a pack of candidates, from number `c` on. Returns whether one is better than all before.
  bool look_at(std::size_t c, double x) {
    const D first = D::load_aligned(plane_[0] + c), second = D::load_aligned(plane_[1] + c);
    D value;
    if constexpr (kSpace)
      value = worth({D(x), first, second}, D(best_));
    else
      value = worth({first, second}, D(best_));
    if (!xsimd::any(value > D(best_))) return false;
    take_best(value, c, x);
    note_second();
    return true;
  }

  /// Takes the best candidate of a pack; among equals that of lowest index.
  void take_best(D value, std::size_t c, double x) {
    alignas(64) double values[kWidth];
    value.store_aligned(values);
    for (std::size_t k = 0; k < kWidth; ++k) {
      if (!(values[k] > best_)) continue;
      best_ = values[k];
      at_[0] = plane_[0][c + k];
      at_[1] = plane_[1][c + k];
      at_[2] = x;
    }
  }

  const Task& task_;
  Sieve<D> first_, second_, guard_;  // states of the two metrics and the guarded one
  SecondMetric<Frame, D> second_metric_ = nullptr, guard_metric_ = nullptr;
  SecondRank<Frame, D> second_rank_;
  double least_second_ = 0.0;       // the rank that the second metric must exceed; 0: unknown
  double best_ = 0.0;               // score of the best place
  double at_[3] = {0.0, 0.0, 0.0};  // best place: along the last two axes, and in space along the first
  double part_[kMaxPoints];         // candidates of an axis, as parts of the grid's size
  alignas(64) double plane_[2][kMaxPlane];
  alignas(64) float from_centre_[2][kBounded ? kMaxPlane : 1];
  std::conditional_t<kBounded, RatioBounds<Frame, D, F>, int> bounds_;
  std::conditional_t<kCut, PlanarCuts<F>, int> cuts_;
};

/// Kernel for the first metric with this translation unit's widest packs.
template <class Frame, class D>
CompositeKernel<Frame> kernel_for(Metric first) {
  return with_metric_of<Frame>(first, []<Metric M>() -> CompositeKernel<Frame> { return &Kernel<M, Frame, D>::run; });
}
template <class Frame, class D>
CompositeListKernel<Frame> list_kernel_for(Metric first) {
  return with_metric_of<Frame>(first, []<Metric M>() -> CompositeListKernel<Frame> { return &Kernel<M, Frame, D>::run_list; });
}

}  // namespace dmoscope::composite
