#pragma once
// Sole definition of the kernel for the mean against targets. Only the kernel_set_*.cpp include it; see lane_kernel_impl.h for what that
// asks of the code.

#include <array>
#include <limits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/smooth/kernels/ratio_bounds.h"
#include "core/smooth/kernels/targets/target_mean_kernel.h"
#include "core/smooth/kernels/targets/target_star.h"

namespace dmoscope::target_mean {

/// Elements of a star with their targets, in packs of the same number. D: pack of doubles.
template <bool Crossed, class Frame, class D>
class MeanStar;

template <bool Crossed, class D>
class MeanStar<Crossed, Plane, D> {
 public:
  explicit MeanStar(const TargetMeanSearch<Plane>& task) : task_(task) {}

  template <class Bounds>
  void give(Bounds& bounds) const {
    std::size_t next = 0;
    for (std::size_t i = 0; i < task_.star.simplices.size; ++i) {
      const CornerTarget<D> target = at(next++);
      const StarTriangle<double>& t = task_.star.simplices.data[i];
      const auto form = target_form_of_triangle<Crossed>(StarTriangle<D>{point_of<D>(t.b), point_of<D>(t.c), D(1.0)}, target);
      bounds.begin_element(target.steepness.get(0), form.shift.get(0));
      bounds.take(form);
    }
    task_.star.for_others([&](const auto& quadrilateral) {
      const StarQuadrilateral<D> q = packs_of(quadrilateral);
      const CornerTarget<D> targets[kQuadrilateralTargets] = {at(next), at(next + 1), at(next + 2), at(next + 3)};
      next += kQuadrilateralTargets;
      TargetForm<D, Crossed> forms[kQuadrilateralTargetForms];
      target_forms_of_quadrilateral<Crossed>(q, targets, forms);
      bounds.begin_element(target_form::ratio<Crossed>(q.d - q.c, q.b - q.c, targets[3]).get(0), forms[0].shift.get(0));
      for (const auto& form : forms) bounds.take(form);
    });
  }
  /// Calls take(metric) with the metric of each element while it returns true. The vertex is at `p`.
  template <class Take>
  void judge(const Vec2<D>& p, const Take& take) const {
    std::size_t next = 0;
    bool goes_on = true;
    for (std::size_t i = 0; i < task_.star.simplices.size && goes_on; ++i) {
      const StarTriangle<double>& t = task_.star.simplices.data[i];
      goes_on = take(corner(point_of<D>(t.b) - p, point_of<D>(t.c) - p, at(next++)));
    }
    task_.star.for_others([&](const auto& quadrilateral) {
      if (!goes_on) return;
      using scalar::min;
      const StarQuadrilateral<D> q = packs_of(quadrilateral);
      const D around = min(corner(q.b - p, q.d - p, at(next)), corner(q.c - q.b, p - q.b, at(next + 1)));
      const D beside = min(corner(p - q.d, q.c - q.d, at(next + 2)), corner(q.d - q.c, q.b - q.c, at(next + 3)));
      next += kQuadrilateralTargets;
      goes_on = take(min(around, beside));
    });
  }

 private:
  [[nodiscard]] CornerTarget<D> at(std::size_t i) const {
    const double* numbers = task_.targets + target_numbers(Crossed) * i;
    return corner_target<Crossed, D>([&](std::size_t k) { return D(numbers[k]); });
  }
  static StarQuadrilateral<D> packs_of(const StarQuadrilateral<double>& q) {
    return {point_of<D>(q.b), point_of<D>(q.c), point_of<D>(q.d), D(1.0)};
  }
  static D corner(Vec2<D> a, Vec2<D> b, const CornerTarget<D>& target) {
    const D ratio = target_form::ratio<Crossed>(a, b, target);
    return xsimd::select(ratio > D(target_star::kSoundRatio), target_form::quality(ratio, target), D(-1e30));
  }

  const TargetMeanSearch<Plane>& task_;
};

template <bool Crossed, class D>
class MeanStar<Crossed, Space, D> {
 public:
  explicit MeanStar(const TargetMeanSearch<Space>& task) : task_(task) {}

  template <class Bounds>
  void give(Bounds& bounds) const {
    for (std::size_t i = 0; i < task_.star.simplices.size; ++i) {
      bounds.begin_element(1.0);
      bounds.take(volumes::target_form<Crossed>(tetrahedron(i)));
    }
  }
  template <class Take>
  void judge(const Vec3Of<D>& p, const Take& take) const {
    for (std::size_t i = 0; i < task_.star.simplices.size; ++i) {
      volumes::TargetTetrahedron<D> there = tetrahedron(i);
      for (Vec3Of<D>& corner : there.at) corner = corner - p;
      const D rank = volumes::target_rank<Crossed>(there);
      const auto sound = rank > D(kSoundRank);
      if (!take(xsimd::select(sound, cube_root_of(xsimd::select(sound, rank, D(1.0))), D(-1e30)))) return;
    }
  }

 private:
  static constexpr double kSoundRank = 1e-12;
  static constexpr std::size_t kRows = 9, kNumbers = kRows + (Crossed ? 6 : 0);

  [[nodiscard]] static D cube_root_of(const D& rank) {
    alignas(64) double slots[D::size];
    rank.store_aligned(slots);
    for (double& slot : slots) slot = scalar::rough_cube_root(slot);
    return scalar::refined_cube_root(rank, D::load_aligned(slots));
  }
  [[nodiscard]] volumes::TargetTetrahedron<D> tetrahedron(std::size_t i) const {
    const StarTetrahedron<double>& t = task_.star.simplices.data[i];
    const double* g = task_.targets + kNumbers * i;
    const auto row = [g](std::size_t k) { return Vec3Of<D>{D(g[3 * k]), D(g[3 * k + 1]), D(g[3 * k + 2])}; };
    volumes::TargetTetrahedron<D> made{{point_of<D>(t.b), point_of<D>(t.c), point_of<D>(t.d)}, {row(0), row(1), row(2)}, {}};
    if constexpr (Crossed) {
      const double* k = g + kRows;
      made.stretch = {D(k[0]), D(k[1]), D(k[2]), D(k[3]), D(k[4]), D(k[5])};
    }
    return made;
  }

  const TargetMeanSearch<Space>& task_;
};

template <bool Crossed, class Frame, class D>
class StarMean {
 public:
  static CompositeFound<Frame> run(const TargetMeanSearch<Frame>& task) {
    StarMean kernel(task);
    return kernel.search();
  }
  static TargetMeanWorth worth_at(const TargetMeanSearch<Frame>& task, OffsetIn<Frame, double> at) {
    const Worth worth = StarMean(task).worth(point_of<D>(at));
    return {worth.least.get(0), worth.sum.get(0), worth.doubt.get(0)};
  }

 private:
  using Point = OffsetIn<Frame, D>;
  using F = Pack<float>;
  using Bounds = composite::RatioBounds<Frame, D, F, Crossed>;
  static constexpr bool kSpace = std::is_same_v<Frame, Space>;
  static constexpr std::size_t kAxes = kSpace ? 3 : 2, kWidth = D::size, kFloats = F::size;
  static constexpr std::size_t kMaxPoints = kMaxCompositePoints, kMaxPlane = kMaxPoints * kMaxPoints + kFloats;
  static constexpr double kUnknown = 1e300;

  struct Worth {
    D least, sum, doubt;
  };

  explicit StarMean(const TargetMeanSearch<Frame>& task) : task_(task), star_(task) {
    std::size_t others = 0;
    task.star.for_others([&others](const auto&) { ++others; });
    count_ = static_cast<double>(task.star.simplices.size + others);
  }

  CompositeFound<Frame> search() {
    const TargetMeanWorth here = worth_at(task_, {});
    if (!(here.least > floor() + task_.doubt) || !(here.doubt < kUnknown)) return {};
    best_ = here.sum, best_doubt_ = here.doubt;
    bounds_.begin(task_.mean);
    bounds_.set_amiss(task_.stretch);
    star_.give(bounds_);
    bounds_.end();
    const auto n = static_cast<std::size_t>(task_.points);
    for (std::size_t i = 0; i < n; ++i) part_[i] = static_cast<double>(i) / static_cast<double>(n - 1) - 0.5;
    double omega = task_.omega;
    for (int level = 0; level < task_.levels; ++level) {
      rival_ = -std::numeric_limits<double>::infinity();
      search_level(omega);
      if (!(rival_ < best_ - best_doubt_)) return {};
      omega *= 2.0 / (task_.points - 1);
    }
    if constexpr (kSpace)
      return {true, {at_[0], at_[1], at_[2]}};
    else
      return {true, {at_[0], at_[1]}};
  }

  [[nodiscard]] double floor() const { return task_.threshold > 0.0 ? task_.threshold : 0.0; }

  /// Score with the vertex at `p`; where the least is below the floor for certain, the least alone.
  [[nodiscard]] Worth worth(const Point& p) const {
    using scalar::min;
    PowerMean<D> mean(task_.mean);
    const D out(floor() - task_.doubt);
    D least(1e30), slopes(0.0), near(1e30);
    star_.judge(p, [&](const D& quality) {
      least = min(least, quality);
      if (!xsimd::any(least >= out)) return false;
      mean.add(quality);
      slopes = slopes + PowerMean<D>::slope(task_.mean, D(1.0) / quality);
      if (task_.mean == MeanKind::Harmonic)
        for (const double step : kMeanSteps) near = min(near, xsimd::abs(quality - D(step)));
      return true;
    });
    return {least, rising(mean.total()), xsimd::select(near > D(task_.doubt), doubt_of(mean, slopes), D(kUnknown))};
  }
  /// Sum of the mean's terms as a number that rises with the mean.
  [[nodiscard]] D rising(const D& total) const { return has_falling_total(task_.mean) ? D(0.0) - total : total; }
  /// Most that rounding may change a sum, both here and where the plain search adds the mean to the threshold. `slopes`: sum of the slopes
  /// by its elements' qualities, of a product over it.
  [[nodiscard]] D doubt_of(const PowerMean<D>& mean, const D& slopes) const {
    const D by_elements = D(2.0 * task_.doubt) * slopes, rounding = D(1e-13) * xsimd::abs(mean.total());
    const D worth(8e-15 * (2.0 + floor()));
    return (is_product(task_.mean) ? by_elements * mean.total() : by_elements) + rounding + worth * mean.slope_of_total(count_);
  }

  void search_level(double omega) {
    const std::array<double, 3> box = box_of(), centre{at_[0], at_[1], at_[2]};
    std::array<double, 3> half{}, width{};
    for (std::size_t axis = 0; axis < kAxes; ++axis) width[axis] = box[axis] * omega, half[axis] = 0.5 * width[axis];
    bounds_.move_to(centre, half);
    set_needs();
    set_plane(centre, width);
    if constexpr (kSpace) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(task_.points); ++i) search_plane(centre[0] + width[0] * part_[i], centre);
    } else {
      search_plane(0.0, centre);
    }
  }
  [[nodiscard]] std::array<double, 3> box_of() const {
    if constexpr (kSpace)
      return {task_.box.x, task_.box.y, task_.box.z};
    else
      return {task_.box.x, task_.box.y, 0.0};
  }
  void set_needs() {
    if (is_product(task_.mean))
      bounds_.set_needs(floor() - task_.doubt, 0.0);
    else
      bounds_.set_needs_of_sum(floor() - task_.doubt, best_ - 4.0 * best_doubt_);
  }

  /// Sets a level's candidates along the last two axes, in the order of their indices: as CandidateGrid has them.
  void set_plane(const std::array<double, 3>& centre, const std::array<double, 3>& width) {
    constexpr std::size_t kFirst = kAxes - 2;
    const auto n = static_cast<std::size_t>(task_.points);
    std::size_t c = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j, ++c) {
        plane_[0][c] = centre[kFirst] + width[kFirst] * part_[i];
        plane_[1][c] = centre[kFirst + 1] + width[kFirst + 1] * part_[j];
      }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (std::size_t k = c; k % kFloats != 0; ++k) plane_[axis][k] = plane_[axis][c - 1];
      for (std::size_t k = 0; k < c || k % kFloats != 0; ++k)
        from_centre_[axis][k] = static_cast<float>(plane_[axis][k] - centre[kFirst + axis]);
    }
  }
  /// Evaluates the candidates of a plane. `x`: in space, the first coordinate of all of them.
  void search_plane(double x, const std::array<double, 3>& centre) {
    const std::size_t candidates = static_cast<std::size_t>(task_.points) * static_cast<std::size_t>(task_.points);
    for (std::size_t c = 0; c < candidates; c += kFloats) {
      const F first = F::load_aligned(from_centre_[0] + c), second = F::load_aligned(from_centre_[1] + c);
      OffsetIn<Frame, F> d{first, second};
      if constexpr (kSpace) d = {F(static_cast<float>(x - centre[0])), first, second};
      const auto hope = bounds_.may_reach(d);
      if (!xsimd::any(hope)) continue;
      alignas(64) float hopeful[kFloats];
      xsimd::select(hope, F(1.0F), F(0.0F)).store_aligned(hopeful);
      for (std::size_t k = 0; k < kFloats; k += kWidth) {
        bool any = false;
        for (std::size_t i = k; i < k + kWidth; ++i) any = any || hopeful[i] > 0.0F;
        if (any) look_at(c + k, candidates, x, centre);
      }
    }
  }
  /// Evaluates a pack of candidates, from number `c` on.
  void look_at(std::size_t c, std::size_t candidates, double x, const std::array<double, 3>& centre) {
    const D first = D::load_aligned(plane_[0] + c), second = D::load_aligned(plane_[1] + c);
    Worth there;
    if constexpr (kSpace)
      there = worth({landed(D(x), task_.here.x), landed(first, task_.here.y), landed(second, task_.here.z)});
    else
      there = worth({landed(first, task_.here.x), landed(second, task_.here.y)});
    if (!xsimd::any((there.least >= D(floor() - task_.doubt)) & (there.sum + there.doubt >= D(best_ - best_doubt_)))) return;
    alignas(64) double least[kWidth], sum[kWidth], doubt[kWidth];
    there.least.store_aligned(least);
    there.sum.store_aligned(sum);
    there.doubt.store_aligned(doubt);
    for (std::size_t k = 0; k < kWidth && c + k < candidates; ++k) {
      if (!(least[k] >= floor() - task_.doubt)) continue;
      std::array<double, 3> at{plane_[0][c + k], plane_[1][c + k], 0.0};
      if constexpr (kSpace) at = {x, at[0], at[1]};
      if (at == centre) continue;  // skips the best so far
      const bool wins = sum[k] > best_ && least[k] > floor() + task_.doubt && doubt[k] < kUnknown;
      const double other = wins ? best_ + best_doubt_ : sum[k] + doubt[k];
      if (!(other < rival_)) rival_ = other;
      if (!wins) continue;
      best_ = sum[k], best_doubt_ = doubt[k], at_ = at;
      set_needs();
    }
  }
  /// Coordinate of candidates from the vertex's present place once their places are rounded.
  [[nodiscard]] D landed(const D& offset, double here) const { return ((D(here) + offset * D(task_.scale)) - D(here)) / D(task_.scale); }

  const TargetMeanSearch<Frame>& task_;
  MeanStar<Crossed, Frame, D> star_;
  double count_ = 0.0;
  double best_ = 0.0, best_doubt_ = 0.0;  // sum
  double rival_ = 0.0;                    // the most that any other place of the level may score
  std::array<double, 3> at_{};            // best place
  double part_[kMaxPoints];               // candidates of an axis, as parts of the grid's size
  alignas(64) double plane_[2][kMaxPlane];
  alignas(64) float from_centre_[2][kMaxPlane];
  Bounds bounds_;
};

/// Kernel with this translation unit's widest packs of doubles, D.
template <class Frame, class D>
TargetMeanKernel<Frame> kernel_for(bool crossed) {
  if (crossed) return {&StarMean<true, Frame, D>::run, &StarMean<true, Frame, D>::worth_at};
  return {&StarMean<false, Frame, D>::run, &StarMean<false, Frame, D>::worth_at};
}

}  // namespace dmoscope::target_mean
