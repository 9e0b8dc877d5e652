#pragma once
// Grid search for the mean of the mean ratio against targets, of a star without inverted elements whose least metric is beyond the
// threshold. In float, by bounds, it finds the candidates that may win, and in double, by packs, the winner: for certain, or it leaves the
// star to the plain search. The same code compiled for several processors, chosen at run time; all find the same.

#include "core/numeric/simd.h"
#include "core/smooth/kernels/composite_kernel.h"

namespace dmoscope {

/// Star, its targets and its aim, as plain data. Lengths are in units of the star's scale. Frame: Plane or Space.
template <class Frame>
struct TargetMeanSearch {
  using Offset = OffsetIn<Frame, double>;

  CompositeLists<Frame> star;  // in space, tetrahedra alone
  /// Targets: in the plane as StarTargets has them; in space for each tetrahedron the three rows of W^-1 of its other corners
  /// (TargetTetrahedron), and K where any is crossed.
  const double* targets = nullptr;
  double doubt = 0.0;    // how far rounding may change the metric of an element
  double stretch = 1.0;  // how much more than without a target rounding may change its form, at least 1
  Offset here{};         // present place of the vertex, in mesh units along the axes of offsets: places are rounded there
  double scale = 1.0;
  Offset box{};
  int points = 8, levels = 3;
  double omega = 0.5;
  double threshold = 0.0;
  MeanKind mean = MeanKind::Harmonic;
};

/// Score of a place, by the search's formulas.
struct TargetMeanWorth {
  double least = 0.0;  // far below 0 where a corner is nearly inverted
  double sum = 0.0;    // sum of the mean's terms, which rises with the mean
  double doubt = 0.0;  // most that rounding may change the sum
};

template <class Frame>
struct TargetMeanKernel {
  CompositeFound<Frame> (*search)(const TargetMeanSearch<Frame>& search) = nullptr;
  TargetMeanWorth (*worth)(const TargetMeanSearch<Frame>& search, OffsetIn<Frame, double> at) = nullptr;
};

}  // namespace dmoscope
