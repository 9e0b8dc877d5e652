#pragma once
// Two aims in one objective (paper, Section 4.2): a first metric up to a threshold, and beyond it a second aim.

#include <string>
#include <variant>

#include "core/base/vec.h"
#include "core/quality/metric.h"

namespace dmoscope {

/// h of the paper's eq. (7): the size that elements shall have, up to a factor common to all of the mesh.
struct SizeFunction {
  enum class Kind {
    Distance,         // h1, eq. (12): the distance to `point`
    InverseDistance,  // h2 = 1 / h1, eq. (13)
    Constant,         // everywhere the same
    Field             // `field`, a nodal field of the mesh's file, taken where the vertex stands, not with the vertex
  };
  Kind kind = Kind::Constant;
  Vec3 point{};         // in the mesh's coordinates
  std::string field{};  // its name
  friend bool operator==(const SizeFunction&, const SizeFunction&) = default;
};

/// What a star is worth to a vertex (paper eq. 8): its least first metric where that is no more than the threshold; beyond the threshold
/// all stars are better than those below, and the second aim counts: the least of another metric, or the density (eq. 6, 7).
struct Combination {
  double threshold = 0.7;
  std::variant<Metric, SizeFunction> second = SizeFunction{};
  friend bool operator==(const Combination&, const Combination&) = default;
};

}  // namespace dmoscope
