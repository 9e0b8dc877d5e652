#pragma once
// Fast search of a volume's star, for one vertex: in float, and comparison of two places in double. The same code compiled for several
// processors, chosen at run time; all give the same bits.

#include "core/base/vec.h"
#include "core/mesh/topology.h"
#include "core/quality/metric.h"
#include "core/quality/power_mean.h"
#include "core/search/parameters.h"
#include "core/smooth/kernels/indexed_star.h"

namespace dmoscope {

/// Targets of a star of tetrahedra: its elements, and by element W^-1, and K where any is crossed (see solid_target.h).
struct VolumeTargets {
  const Incidence* star = nullptr;
  const double* numbers = nullptr;
};

/// Star in float, and parameters of its search.
struct VolumeSearch {
  IndexedStar star;
  const Vec3Of<float>* others = nullptr;  // offsets from the vertex, in units of the star's scale
  Vec3Of<float> box;
  int points = 8, levels = 3;
  double omega = 0.5;
  VolumeTargets targets{};  // for KernelSet::target_volume
};

struct VolumeFound {
  bool ready = false;      // false: the star is so bad that the reference must search it
  Vec3Of<float> offset{};  // units of the star's scale; 0 where no candidate is better
};

/// Star in double, and two places for its vertex.
struct VolumeComparison {
  IndexedStar star;
  const Vec3* others = nullptr;  // positions
  Vec3 before, after;
  VolumeTargets targets{};
};

struct BeforeAndAfter {
  double before = 0.0, after = 0.0;
};

struct VolumeKernel {
  VolumeFound (*search)(const VolumeSearch& search) = nullptr;
  // Comparisons by the elements for which the metric is defined:
  BeforeAndAfter (*least_ranks)(const VolumeComparison& comparison) = nullptr;           // formulas::rank_around
  BeforeAndAfter (*means)(const VolumeComparison& comparison, MeanKind kind) = nullptr;  // formulas::metric
  // Returns whether every hexahedron and wedge is certain to be valid inside with the vertex at `after`. Where not, validity_of() has to
  // say.
  bool (*valid_after)(const VolumeComparison& comparison) = nullptr;
};

}  // namespace dmoscope
