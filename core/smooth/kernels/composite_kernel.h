#pragma once
// The grid search for two aims (composite_dmo.h) of a star without inverted elements: a pack of candidates at a time, in double. The same
// code compiled for several processors, chosen at run time; each slot gets the bits that the plain search gets, so that it finds the same.

#include <cstddef>

#include "core/quality/metric.h"
#include "core/search/parameters.h"
#include "core/search/star.h"

namespace dmoscope {

/// A star and its aims as plain data. Frame: Plane or Space. Lengths are in units of the star's scale.
template <class Frame>
struct CompositeSearch {
  using Offset = OffsetIn<Frame, double>;
  enum class Second { Mean, Metric, Density };

  StarListsIn<Frame, double> star;
  Offset box;
  int points = 8, levels = 3;
  double omega = 0.5;

  double threshold = 0.0;
  bool inclusive = false;  // is a star whose least is the threshold beyond it?
  Second second = Second::Mean;
  Metric metric = Metric::MeanRatio;  // Second::Metric
  Offset wanted{};                    // Second::Density: see DensityTarget
  double edge = 0.0;
};

template <class Frame>
struct CompositeFound {
  bool ready = false;                // false: the search is the plain one's
  OffsetIn<Frame, double> offset{};  // 0 where no candidate is better
};

/// At most this many triangles or tetrahedra of a star, other elements, and candidates per axis; more are the plain search's.
inline constexpr std::size_t kMaxSimplices = 96, kMaxOthers = 64;
inline constexpr int kMaxCompositePoints = 64;

template <class Frame>
using CompositeKernel = CompositeFound<Frame> (*)(const CompositeSearch<Frame>& search);

/// The kernel whose first aim is a metric that is defined for the frame. `level` must be one of supported_simd_levels().
template <class Frame>
[[nodiscard]] CompositeKernel<Frame> composite_kernel(SimdLevel level, Metric first);

}  // namespace dmoscope
