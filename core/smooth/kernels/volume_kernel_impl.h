#pragma once
// The one definition of the volumes' kernel. Only the volume_kernel_*.cpp, each compiled for one kind of processor, include it; see
// lane_kernel_impl.h for what that asks of the code.

#include <array>
#include <limits>

#include "core/numeric/pack.h"
// After the packs:
#include "core/search/grid_search.h"
#include "core/smooth/kernels/volume_form.h"
#include "core/smooth/kernels/volume_kernel.h"

namespace dmoscope::volumes {

/// F: pack of floats, a candidate per slot.
template <Metric M, class F>
class Kernel {
 public:
  static VolumeFound run(const VolumeSearch& task) {
    Kernel kernel(task);
    return kernel.search();
  }

 private:
  using Point = Vec3Of<F>;
  static constexpr std::size_t kWidth = F::size;
  static constexpr std::size_t kMaxPlane = 64 * 64 + kWidth;
  static constexpr bool kForms = M == Metric::MeanRatio;
  static constexpr bool kCorners = !kForms && formulas::kDefinedForCorners<M>;
  static constexpr std::size_t kMaxForms = 5 * 4 * kMaxSolids;  // lists, and corners of an element that one vertex changes
  static constexpr float kMost = std::numeric_limits<float>::max();

  explicit Kernel(const VolumeSearch& task) : task_(task) {}

  VolumeFound search() {
    VolumeFound found;
    take_elements();
    best_ = least({F(0), F(0), F(0)}, F(-1)).get(0);
    found.ready = best_ > kLeastRank;
    if (!found.ready) return found;
    double omega = task_.omega;
    for (int level = 0; level < task_.levels; ++level) {
      search_level(static_cast<float>(omega));
      omega *= 2.0 / (task_.points - 1);
    }
    found.offset = {at_[0], at_[1], at_[2]};
    return found;
  }

  void take_elements() {
    if constexpr (kForms) {
      for (std::size_t i = 0; i < task_.star.simplices.size; ++i) {
        const StarTetrahedron<float>& t = task_.star.simplices.data[i];
        take(volumes::tetrahedron_form(point_of<F>(t.b), point_of<F>(t.c), point_of<F>(t.d)));
      }
      const Point origin{F(0), F(0), F(0)};
      task_.star.for_others([&](const auto& element) {
        for_corner_forms(element.with(origin), element.kMoving, [this](const MeanRatioForm<F>& form) { take(form); });
      });
    } else {
      count_ = task_.star.simplices.size;
      for (std::size_t i = 0; i < count_; ++i) {
        const StarTetrahedron<float>& t = task_.star.simplices.data[i];
        tetrahedra_[i] = {point_of<F>(t.b), point_of<F>(t.c), point_of<F>(t.d), F(1)};
      }
    }
    for (std::size_t i = 0; i < count_; ++i) order_[i] = static_cast<std::uint16_t>(i);
  }
  void take(const MeanRatioForm<F>& f) {
    forms_[count_++] = {f.v0.get(0), f.vx.get(0), f.vy.get(0), f.vz.get(0),    f.s0.get(0),
                        f.sx.get(0), f.sy.get(0), f.sz.get(0), f.square.get(0)};
  }

  /// The least rank of the star with its vertex at each of the places; anything not above `floor` where it is not above it in any slot.
  F least(Point p, F floor) {
    using scalar::min;
    F worth(kMost);
    if constexpr (kForms) {
      if (!may_pass(p, floor)) return F(-1);
      const F square = dot(p, p);
      for (std::size_t i = 0; i < count_; ++i) worth = min(worth, rank_of(forms_[i], p, square));
    } else {
      for (std::size_t i = 0; i < count_; ++i) {
        const std::size_t k = order_[i];
        worth = min(worth, formulas::rank<M>(tetrahedra_[k].with(p)));
        if (!xsimd::any(worth > floor)) {
          to_front(i);
          return worth;
        }
      }
    }
    if constexpr (kCorners) {
      bool passes = true;
      task_.star.for_others([&](const auto& element) {
        if (!passes) return;
        worth = min(worth, formulas::rank_around<M>(element.with(p), element.kMoving));
        passes = xsimd::any(worth > floor);
      });
    }
    return worth;
  }

  /// Without division: can any of the candidates have a rank above the floor? Most cannot, and the first few forms tell.
  bool may_pass(const Point& p, F floor) {
    const F square = dot(p, p), threshold = floor * F(1.0F - 1e-4F);
    auto passes = square == square;
    for (std::size_t i = 0; i < count_; ++i) {
      const MeanRatioForm<float>& f = forms_[order_[i]];
      const F v = determinant_of(f, p), s = squares_of(f, p, square);
      passes = passes & (v * xsimd::abs(v) >= threshold * s * s * s);
      if (!xsimd::any(passes)) {
        to_front(i);
        return false;
      }
    }
    return true;
  }

  /// The one that decided is likely to decide the next.
  void to_front(std::size_t i) {
    const std::uint16_t k = order_[i];
    for (; i > 0; --i) order_[i] = order_[i - 1];
    order_[0] = k;
  }

  void search_level(float omega) {
    const auto n = static_cast<std::size_t>(task_.points);
    const CandidateGrid<F, Point> grid{
        {F(at_[0]), F(at_[1]), F(at_[2])}, {F(task_.box.x) * F(omega), F(task_.box.y) * F(omega), F(task_.box.z) * F(omega)}, task_.points};
    for (std::size_t i = 0; i < n * n; ++i) {
      const Point p = grid.at(0, static_cast<int>(i / n), static_cast<int>(i % n));
      y_[i] = p.y.get(0);
      z_[i] = p.z.get(0);
    }
    for (std::size_t i = n * n; i % kWidth != 0; ++i) {  // once more the last, which cannot be better than itself
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

  /// Among equals the candidate of lowest index.
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
  float best_ = 0.0F;  // rank
  float at_[3] = {0.0F, 0.0F, 0.0F};
  std::size_t count_ = 0;  // of the forms, or of the tetrahedra
  std::uint16_t order_[kForms ? kMaxForms : kMaxSolids];
  alignas(64) float y_[kMaxPlane], z_[kMaxPlane];
  std::array<MeanRatioForm<float>, kForms ? kMaxForms : 1> forms_;
  std::array<StarTetrahedron<F>, kForms ? 1 : kMaxSolids> tetrahedra_;
};

/// The kernel for `metric` with this translation unit's widest packs.
template <class F>
VolumeKernel kernel_for(Metric metric) {
  return formulas::with_volume_metric(metric, []<Metric M>() -> VolumeKernel { return &Kernel<M, F>::run; });
}

}  // namespace dmoscope::volumes
