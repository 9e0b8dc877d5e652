#pragma once
// Sole definition of the volumes' kernel. Only the kernel_set_*.cpp, each compiled for one kind of processor, include it; see
// lane_kernel_impl.h for what that asks of the code.

#include <array>
#include <limits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/quality/validity.h"
#include "core/search/grid_search.h"
#include "core/smooth/kernels/mean_ratio_search.h"
#include "core/smooth/kernels/star_packs.h"
#include "core/smooth/kernels/volume_form.h"
#include "core/smooth/kernels/volume_kernel.h"
#include "core/smooth/kernels/volume_levels.h"

namespace dmoscope::volumes {

/// Grid search by any metric's rank. F: pack of floats, a candidate per slot.
template <Metric M, class F>
class RankSearch {
 public:
  explicit RankSearch(const VolumeSearch& task) : task_(task) {
    for_elements<true>([this](const StarTetrahedron<float>& t) {
      order_[count_] = static_cast<std::uint16_t>(count_);
      tetrahedra_[count_++] = {point_of<F>(t.b), point_of<F>(t.c), point_of<F>(t.d), F(1)};
    });
  }

  /// Least rank with the vertex at its present place; the search begins there.
  [[nodiscard]] float begin() { return best_ = least({F(0), F(0), F(0)}, F(-1)).get(0); }

  /// Goes to the best candidate of a grid around the best place so far, where one is better; among equals to that of lowest index.
  void search_level(float size_x, float size_y, float size_z) {
    const auto n = static_cast<std::size_t>(task_.points);
    const CandidateGrid<F, Point> grid{{F(at_[0]), F(at_[1]), F(at_[2])}, {F(size_x), F(size_y), F(size_z)}, task_.points};
    for (std::size_t i = 0; i < n * n; ++i) {
      const Point p = grid.at(0, static_cast<int>(i / n), static_cast<int>(i % n));
      y_[i] = p.y.get(0);
      z_[i] = p.z.get(0);
    }
    for (std::size_t i = n * n; i % kWidth != 0; ++i) {  // repeats the last, which cannot be better than itself
      y_[i] = y_[n * n - 1];
      z_[i] = z_[n * n - 1];
    }
    for (std::size_t i = 0; i < n; ++i) {
      const F x = grid.at(static_cast<int>(i), 0, 0).x;
      for (std::size_t j = 0; j < n * n; j += kWidth) {
        const F rank = least({x, F::load_aligned(y_ + j), F::load_aligned(z_ + j)}, F(best_));
        if (xsimd::any(rank > F(best_))) take_best(rank, x, j);
      }
    }
  }

  [[nodiscard]] Vec3Of<float> best() const { return {at_[0], at_[1], at_[2]}; }

 private:
  using Point = Vec3Of<F>;
  static constexpr std::size_t kWidth = F::size;
  static constexpr std::size_t kMaxPlane = 64 * 64 + kWidth;

  /// Calls take(element) with the star's tetrahedra, or with all its other elements.
  template <bool Tetrahedra, class Take>
  void for_elements(const Take& take) const {
    for_kinds<float>(task_.star, [&]<class Element>(const std::uint16_t* corners, std::size_t count, std::size_t others) {
      if constexpr (std::is_same_v<Element, StarTetrahedron<float>> == Tetrahedra)
        for (std::size_t i = 0; i < count; ++i, corners += others)
          take(element_of<Element>([&](std::size_t k) { return task_.others[corners[k]]; }));
    });
  }

  /// Least rank of the star with its vertex at each of the places; any rank not above `floor` where it is not above it in any slot.
  F least(Point p, F floor) {
    using scalar::min;
    F worth(std::numeric_limits<float>::max());
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t k = order_[i];
      worth = min(worth, formulas::rank<M>(tetrahedra_[k].with(p)));
      if (!xsimd::any(worth > floor)) {
        to_front(i);
        return worth;
      }
    }
    if constexpr (formulas::kDefinedForCorners<M>) {
      bool passes = true;
      for_elements<false>([&](const auto& element) {
        if (!passes) return;
        worth = min(worth, formulas::rank_around<M>(element.with(p), element.kMoving));
        passes = xsimd::any(worth > floor);
      });
    }
    return worth;
  }

  /// Moves an element to the front: the one that decided is likely to decide the next.
  void to_front(std::size_t i) {
    const std::uint16_t k = order_[i];
    for (; i > 0; --i) order_[i] = order_[i - 1];
    order_[0] = k;
  }

  /// Takes the best candidate of a pack; among equals that of lowest index.
  void take_best(F rank, F x, std::size_t j) {
    alignas(64) float ranks[kWidth];
    rank.store_aligned(ranks);
    for (std::size_t k = 0; k < kWidth; ++k) {
      if (!(ranks[k] > best_)) continue;
      best_ = ranks[k];
      at_[0] = x.get(0);
      at_[1] = y_[j + k];
      at_[2] = z_[j + k];
    }
  }

  const VolumeSearch& task_;
  float best_ = 0.0F;  // rank of the best place
  float at_[3] = {0.0F, 0.0F, 0.0F};
  std::size_t count_ = 0;  // number of tetrahedra
  std::uint16_t order_[kMaxSolids];
  alignas(64) float y_[kMaxPlane], z_[kMaxPlane];
  std::array<StarTetrahedron<F>, kMaxSolids> tetrahedra_;
};

/// Grid search by the mean ratio.
template <class F>
class FormSearch : public MeanRatioSearch<F> {
 public:
  explicit FormSearch(const VolumeSearch& task) : MeanRatioSearch<F>(task.points) {
    const Vec3Of<F> origin{F(0), F(0), F(0)};
    for_packs<F>(task.star, task.others, [&]<class Element>(const Element& element, std::size_t /*used*/) {
      if constexpr (std::is_same_v<Element, StarTetrahedron<F>>)
        this->take(tetrahedron_form(element.b, element.c, element.d));
      else
        for_corner_forms(element.with(origin), element.kMoving, [this](const MeanRatioForm<F>& forms) { this->take(forms); });
    });
  }
};

/// Least ranks of the elements for which the metric is defined. D: pack of doubles, an element per slot.
template <Metric M, class D>
[[gnu::flatten]] BeforeAndAfter least_ranks(const VolumeComparison& task) {
  using scalar::min;
  const Vec3Of<D> before = point_of<D>(task.before), after = point_of<D>(task.after);
  D least_before(std::numeric_limits<double>::max()), least_after(std::numeric_limits<double>::max());
  for_packs<D>(task.star, task.others, [&]<class Element>(const Element& element, std::size_t /*used*/) {
    if constexpr (std::is_same_v<Element, StarTetrahedron<D>> || formulas::kDefinedForCorners<M>) {
      least_before = min(least_before, formulas::rank_around<M>(element.with(before), element.kMoving));
      least_after = min(least_after, formulas::rank_around<M>(element.with(after), element.kMoving));
    }
  });
  return {least_slot_of(least_before), least_slot_of(least_after)};
}
template <Metric M, class D>
[[gnu::flatten]] BeforeAndAfter means(const VolumeComparison& task, MeanKind kind) {
  const Vec3Of<D> before = point_of<D>(task.before), after = point_of<D>(task.after);
  alignas(64) double numbers[D::size];
  for (std::size_t k = 0; k < D::size; ++k) numbers[k] = static_cast<double>(static_cast<std::int32_t>(k));
  const D slot = D::load_aligned(numbers);
  PowerMean<D> mean_before(kind), mean_after(kind);
  double count = 0.0;
  for_packs<D>(task.star, task.others, [&]<class Element>(const Element& element, std::size_t used) {
    if constexpr (std::is_same_v<Element, StarTetrahedron<D>> || formulas::kDefinedForCorners<M>) {
      const double here = static_cast<double>(static_cast<std::int32_t>(used));
      const auto counts = slot < D(here);
      const auto add = [&](PowerMean<D>& mean, const Vec3Of<D>& at) {
        mean.join(xsimd::select(counts, mean.term(formulas::metric<M>(element.with(at))), mean.neutral()));
      };
      add(mean_before, before);
      add(mean_after, after);
      count += here;
    }
  });
  const auto value = [&](const PowerMean<D>& mean) {
    mean.total().store_aligned(numbers);
    PowerMean<double> all(kind);
    for (const double each : numbers) all.join(each);
    return all.value(count);
  };
  return {value(mean_before), value(mean_after)};
}

template <class D>
[[gnu::flatten]] bool valid_after(const VolumeComparison& task) {
  using scalar::min;
  const Vec3Of<D> after = point_of<D>(task.after);
  D least(std::numeric_limits<double>::max());
  for_packs<D>(task.star, task.others, [&](const auto& element, std::size_t /*used*/) {
    const auto shape = element.with(after);
    if constexpr (requires { validity::coefficients_of(shape); }) least = min(least, validity::least_coefficient(shape));
  });
  return least_slot_of(least) > validity::kRounding;
}

/// Kernel for `metric` with this translation unit's widest packs of floats, F, and of doubles, D.
template <class F, class D>
VolumeKernel kernel_for(Metric metric) {
  return formulas::with_volume_metric(metric, []<Metric M>() -> VolumeKernel {
    using Search = std::conditional_t<M == Metric::MeanRatio, FormSearch<F>, RankSearch<M, F>>;
    return {&search_levels<Search>, &least_ranks<M, D>, &means<M, D>, &valid_after<D>};
  });
}

}  // namespace dmoscope::volumes
