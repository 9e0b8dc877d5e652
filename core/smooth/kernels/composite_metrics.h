#pragma once
// Metrics of a star for the kernel for two aims, for a pack of places at a time: the least, given up where no place is hopeful any more.
// Only composite_kernel_impl.h includes it; see lane_kernel_impl.h for what that asks of the code.

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/grid_search.h"
#include "core/smooth/kernels/composite_kernel.h"

namespace dmoscope::composite {

/// Calls f.template operator()<M>() with a metric of the frame.
template <class Frame, class F>
[[gnu::always_inline]] inline decltype(auto) with_metric_of(Metric metric, F f) {
  if constexpr (std::is_same_v<Frame, Space>)
    return formulas::with_volume_metric(metric, f);
  else
    return formulas::with_planar_metric(metric, f);
}

/// Star as Objective needs it.
template <class Frame>
struct Lists {
  const CompositeLists<Frame>* star;
  template <bool Others, class F>
  void for_each(F f) const {
    for (std::size_t i = 0; i < star->simplices.size; ++i) f(star->simplices.data[i]);
    if constexpr (Others) star->for_others(f);
  }
};

/// Least of a metric over the corners that stay as they are when corner `moving` moves: found once for all places.
template <Metric M, class V, class Ideal, std::size_t N, class Corners>
formulas::RealOf<V> least_elsewhere(const formulas::CorneredSolid<V, Ideal, N, Corners>& solid, Index moving) {
  using scalar::min;
  auto least = scalar::constant<formulas::RealOf<V>>(HUGE_VAL);
  for (std::size_t i = 0; i < Corners::kTable.size(); ++i) {
    const CornerTable c = formulas::row_of<Corners>(i);
    if (c[0] == moving || c[1] == moving || c[2] == moving || c[3] == moving) continue;
    const V a = solid.at[c[0]], u = solid.at[c[1]] - a, v = solid.at[c[2]] - a, w = solid.at[c[3]] - a;
    least = min(least, formulas::Formula<M>::template corner<Ideal>(u, v, w, formulas::determinant(u, v, w)));
  }
  return least;
}
/// Returns whether an element is judged by its corners, of which some stay.
template <class Shape>
inline constexpr bool kHasCorners = requires(const Shape& shape) {
  least_elsewhere<Metric::MeanRatio>(shape, Index{});
};

/// State of one metric that is kept from a pack of places to the next.
template <class D>
struct Sieve {
  Sieve(std::size_t simplices, bool with_others) : keeps_others(with_others) {
    for (std::size_t i = 0; i < simplices; ++i) order[i] = static_cast<std::uint16_t>(i);
  }
  /// Moves an element to the front: the one that decided is likely to decide the next.
  void to_front(std::size_t i) {
    const std::uint16_t k = order[i];
    for (; i > 0; --i) order[i] = order[i - 1];
    order[0] = k;
  }
  std::uint16_t order[kMaxSimplices];  // order in which simplices are looked at
  bool keeps_others;
  // Qualities of the elements with the vertex at the places evaluated last:
  std::array<D, kMaxSimplices> quality;
  std::array<D, kMaxOthers> others;
  std::array<D, kMaxOthers> elsewhere;  // least of their corners that stay
};

/// Finds the least of the corners that stay for the elements that are no simplices.
template <Metric M, class Frame, class D>
void find_elsewhere(const CompositeLists<Frame>& star, Sieve<D>& sieve) {
  std::size_t k = 0;
  star.for_others([&](const auto& element) {
    const auto shape = element.with(OffsetIn<Frame, D>{});
    if constexpr (kHasCorners<std::remove_cvref_t<decltype(shape)>>) sieve.elsewhere[k] = least_elsewhere<M>(shape, element.kMoving);
    ++k;
  });
}

/// Least of the other elements and `least`, that of the simplices.
template <Metric M, class Frame, class D, class Hopeful>
D least_of_others(const CompositeLists<Frame>& star, const OffsetIn<Frame, D>& p, Sieve<D>& sieve, D least, const Hopeful& hopeful) {
  using scalar::min;
  bool goes_on = true;
  std::size_t k = 0;
  star.for_others([&](const auto& element) {
    if (!goes_on) return;
    const auto shape = element.with(p);
    if constexpr (kHasCorners<std::remove_cvref_t<decltype(shape)>>) {
      const D around = formulas::metric_around<M>(shape, element.kMoving);
      if (sieve.keeps_others) sieve.others[k] = min(sieve.elsewhere[k], around);
      ++k;
      least = min(least, around);
    } else if (sieve.keeps_others) {
      const auto found = formulas::metric_whole_and_around<M>(shape, element.kMoving);
      sieve.others[k++] = found.whole;
      least = min(least, found.around);
    } else {
      least = min(least, formulas::metric_around<M>(shape, element.kMoving));
    }
    goes_on = hopeful(least);
  });
  return least;
}

/// Least of a metric with the vertex at each of the places, as Objective finds it; where no slot is hopeful any more, hopeful(least so
/// far), the least so far.
template <Metric M, class Frame, class D, class Hopeful>
D least_at(const CompositeLists<Frame>& star, const OffsetIn<Frame, D>& p, Sieve<D>& sieve, const Hopeful& hopeful) {
  using Point = OffsetIn<Frame, D>;
  using scalar::min;
  D least(static_cast<double>(std::numeric_limits<float>::max()));
  for (std::size_t i = 0; i < star.simplices.size; ++i) {
    const std::size_t k = sieve.order[i];
    sieve.quality[k] = formulas::metric<M>(star.simplices.data[k].with(p));
    least = min(least, sieve.quality[k]);
    if (!hopeful(least)) {
      sieve.to_front(i);
      return least;
    }
  }
  if constexpr (!formulas::kSignTellsInversion<M, Point>)
    return Objective<M, false, D, Value::Metric, Lists<Frame>>({&star})(p);
  else if constexpr (formulas::kDefinedForOthers<M, Point>)
    least = least_of_others<M, Frame, D>(star, p, sieve, least, hopeful);
  return least;
}

/// Function that gives `threshold` plus the least value of the second metric; in slots where that does not exceed `best`, any value that
/// does not either. One function for each metric, so that no kernel is needed for each pair of metrics.
template <class Frame, class D>
using SecondMetric = D (*)(const CompositeLists<Frame>& star, const OffsetIn<Frame, D>& p, Sieve<D>& sieve, D threshold, D best);
template <Metric M, class Frame, class D>
D second_metric(const CompositeLists<Frame>& star, const OffsetIn<Frame, D>& p, Sieve<D>& sieve, D threshold, D best) {
  return threshold + least_at<M, Frame, D>(star, p, sieve, [&](D least) { return xsimd::any(threshold + least > best); });
}

/// Cheap test that most places fail that are worse than the best one: the least rank (see formulas::rank) with the vertex at each of the
/// places or, where none is above `floor`, that so far; and the difference of ranks that is certain.
template <class Frame, class D>
struct SecondRank {
  D (*least)(const CompositeLists<Frame>& star, const OffsetIn<Frame, D>& p, Sieve<D>& sieve, double floor) = nullptr;
  double (*doubt)(double rank) = nullptr;
};
template <Metric M, class Frame, class D>
D least_rank(const CompositeLists<Frame>& star, const OffsetIn<Frame, D>& p, Sieve<D>& sieve, double floor) {
  using scalar::min;
  D least(static_cast<double>(std::numeric_limits<float>::max()));
  for (std::size_t i = 0; i < star.simplices.size; ++i) {
    least = min(least, formulas::rank<M>(star.simplices.data[sieve.order[i]].with(p)));
    if (xsimd::any(least > D(floor))) continue;
    sieve.to_front(i);
    return least;
  }
  if constexpr (formulas::kDefinedForOthers<M, OffsetIn<Frame, D>>)
    star.for_others([&](const auto& element) {
      if (xsimd::any(least > D(floor))) least = min(least, formulas::rank_around<M>(element.with(p), element.kMoving));
    });
  return least;
}
/// Rank test for a metric; none for metrics that are their own rank or cost as much, or whose sign does not tell inverted elements.
template <Metric M, class Frame, class D>
SecondRank<Frame, D> second_rank() {
  using Point = OffsetIn<Frame, D>;
  using Simplex = std::remove_cvref_t<decltype(CompositeLists<Frame>{}.simplices.data->with(Point{}))>;
  constexpr bool kHasRank = requires(const Simplex& simplex) { formulas::Formula<M>::rank_triangle(simplex); }
  || requires(const Simplex& simplex) { formulas::Formula<M>::rank_tetrahedron(simplex); };
  if constexpr (kHasRank && M != Metric::RadiusRatio && formulas::kSignTellsInversion<M, Point>)
    return {&least_rank<M, Frame, D>, [](double rank) { return formulas::rank_doubt<M>(rank); }};
  return {};
}

}  // namespace dmoscope::composite
