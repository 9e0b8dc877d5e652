#pragma once
// Sole definition of the volumes' kernel for tetrahedra that have targets. Only the kernel_set_*.cpp include it; see lane_kernel_impl.h for
// what that asks of the code.

#include <limits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/star.h"
#include "core/smooth/kernels/mean_ratio_search.h"
#include "core/smooth/kernels/solid_target.h"
#include "core/smooth/kernels/volume_kernel.h"
#include "core/smooth/kernels/volume_levels.h"

namespace dmoscope::volumes {

/// Calls take(TargetTetrahedron<R>) with packs of a star's elements, an element per slot; the slots that are left repeat the last one.
/// `points`: those of the star's other vertices. Real: R's number.
template <bool Crossed, class R, class Real, class Take>
[[gnu::always_inline]] inline void for_target_packs(const IndexedStar& star, const VolumeTargets& targets, const Vec3Of<Real>* points,
                                                    const Take& take) {
  constexpr std::size_t kWidth = R::size, kNumbers = solid_target_numbers(Crossed);
  const std::size_t count = star.counts[static_cast<std::size_t>(StarKind::Tetrahedra)];
  alignas(64) Real at[3][3][kWidth], rows[3][3][kWidth], stretch[6][kWidth];
  for (std::size_t first = 0; first < count; first += kWidth) {
    for (std::size_t slot = 0; slot < kWidth; ++slot) {
      const std::size_t i = first + slot < count ? first + slot : count - 1;
      const Incidence here = targets.star[i];
      const double* g = targets.numbers + kNumbers * here.element;
      const double of_corner[4][3] = {
          {-(g[0] + g[1] + g[3]), -(g[2] + g[4]), -g[5]}, {g[0], 0.0, 0.0}, {g[1], g[2], 0.0}, {g[3], g[4], g[5]}};
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3Of<Real>& point = points[star.corners[3 * i + k]];
        const double* row = of_corner[here.corner ^ static_cast<Index>(k + 1)];  // order of turned::tetrahedron
        at[k][0][slot] = point.x;
        at[k][1][slot] = point.y;
        at[k][2][slot] = point.z;
        for (std::size_t m = 0; m < 3; ++m) rows[k][m][slot] = static_cast<Real>(row[m]);
      }
      if constexpr (Crossed)
        for (std::size_t k = 0; k < 6; ++k) stretch[k][slot] = static_cast<Real>(g[6 + k]);
    }
    const auto load = [](const Real(&a)[3][kWidth]) -> Vec3Of<R> {
      return {R::load_aligned(a[0]), R::load_aligned(a[1]), R::load_aligned(a[2])};
    };
    TargetTetrahedron<R> t{{load(at[0]), load(at[1]), load(at[2])}, {load(rows[0]), load(rows[1]), load(rows[2])}, {}};
    if constexpr (Crossed)
      t.stretch = {R::load_aligned(stretch[0]), R::load_aligned(stretch[1]), R::load_aligned(stretch[2]),
                   R::load_aligned(stretch[3]), R::load_aligned(stretch[4]), R::load_aligned(stretch[5])};
    take(t);
  }
}

template <bool Crossed, class F>
struct TargetSearchOf {
  using type = MeanRatioSearch<F, MeanRatioForm>;
};
template <class F>
struct TargetSearchOf<true, F> {
  using type = MeanRatioSearch<F, StretchedForm>;
};

template <bool Crossed, class F>
class TargetSearch : public TargetSearchOf<Crossed, F>::type {
 public:
  explicit TargetSearch(const VolumeSearch& task) : TargetSearchOf<Crossed, F>::type(task.points) {
    for_target_packs<Crossed, F>(task.star, task.targets, task.others,
                                 [this](const TargetTetrahedron<F>& t) { this->take(target_form<Crossed>(t)); });
  }
};

template <bool Crossed, class D>
[[gnu::flatten]] BeforeAndAfter least_target_ranks(const VolumeComparison& task) {
  using scalar::min;
  const Vec3Of<D> before = point_of<D>(task.before), after = point_of<D>(task.after);
  D least_before(std::numeric_limits<double>::max()), least_after(std::numeric_limits<double>::max());
  for_target_packs<Crossed, D>(task.star, task.targets, task.others, [&](const TargetTetrahedron<D>& t) {
    const auto rank_at = [&t](Vec3Of<D> p) {
      TargetTetrahedron<D> there = t;
      for (Vec3Of<D>& corner : there.at) corner = corner - p;
      return target_rank<Crossed>(there);
    };
    least_before = min(least_before, rank_at(before));
    least_after = min(least_after, rank_at(after));
  });
  return {least_slot_of(least_before), least_slot_of(least_after)};
}

/// Kernel with this translation unit's widest packs of floats, F, and of doubles, D.
template <class F, class D>
VolumeKernel target_kernel_for(bool crossed) {
  if (crossed) return {&search_levels<TargetSearch<true, F>>, &least_target_ranks<true, D>, nullptr};
  return {&search_levels<TargetSearch<false, F>>, &least_target_ranks<false, D>, nullptr};
}

}  // namespace dmoscope::volumes
