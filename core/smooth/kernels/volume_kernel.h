#pragma once
// The fast search of a volume's star: one vertex, a pack of candidates at a time, in float. The same code compiled for several processors,
// chosen at run time; all give the same bits.

#include <cstddef>

#include "core/quality/metric.h"
#include "core/search/parameters.h"
#include "core/search/star.h"

namespace dmoscope {

/// A star in float, and how it is to be searched.
struct VolumeSearch {
  SolidLists<float> star;
  Vec3Of<float> box;
  int points = 8, levels = 3;
  double omega = 0.5;
};

struct VolumeFound {
  bool ready = false;      // false: the star is so bad that its search is the reference's
  Vec3Of<float> offset{};  // units of the star's scale; 0 where no candidate is better
};

/// At most this many elements of a kind; others are the reference's.
inline constexpr std::size_t kMaxSolids = 96;

using VolumeKernel = VolumeFound (*)(const VolumeSearch& search);

/// The kernel for a metric that is defined for volumes. `level` must be one of supported_simd_levels().
[[nodiscard]] VolumeKernel volume_kernel(SimdLevel level, Metric metric);

}  // namespace dmoscope
