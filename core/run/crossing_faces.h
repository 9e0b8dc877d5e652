#pragma once
// Faces of a surface that cross each other, though they share no vertex: sliding bounds how far they leave the input, not each other.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/run/run.h"

namespace dmoscope {

/// Pairs of faces without a common vertex of which one goes through the other, certainly: what may be rounding does not count, nor what
/// merely touches. Quadrilaterals are split by their shorter diagonals.
[[nodiscard]] std::uint64_t count_crossing_faces(const ElementTable& faces, std::span<const Vec3> positions);

struct CrossingFaces {
  std::uint64_t before = 0, after = 0;  // pairs, in the input and where the run stands
  double max_deviation = 0.0;           // the run's
  /// "12 pairs of faces cross each other, and 3 in the input. The bound of deviation lets parts of a surface meet that are nearer to each
  /// other: a smaller max-deviation than 0.001 keeps them apart."
  [[nodiscard]] std::string sentence() const;
};

/// None where no faces slide, and where no more of them cross than in the input. Brings the positions.
[[nodiscard]] std::optional<CrossingFaces> find_crossing_faces(const Run& run);

}  // namespace dmoscope
