#pragma once
// Faces of a surface that cross each other, though they share no vertex: sliding bounds how far they leave the input, not each other.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/run/run.h"

namespace dmoscope {

/// Number of pairs of faces without a common vertex that certainly cross each other: neither faces that merely touch nor crossings that may
/// be rounding count. Quadrilaterals are split by their shorter diagonals.
[[nodiscard]] std::uint64_t count_crossing_faces(const ElementTable& faces, std::span<const Vec3> positions);

struct CrossingFaces {
  std::uint64_t before = 0, after = 0;  // pairs, in the input and in the run's present state
  double max_deviation = 0.0;           // greatest deviation of the run
  /// Sentence for a person: "12 pairs of faces cross each other, and 3 in the input. The bound of deviation lets parts of a surface meet
  /// that are nearer to each other: a smaller max-deviation than 0.001 keeps them apart."
  [[nodiscard]] std::string sentence() const;
};

/// Returns none where no faces slide, and where no more of them cross than in the input. Brings the positions to the host.
[[nodiscard]] std::optional<CrossingFaces> find_crossing_faces(const Run& run);

}  // namespace dmoscope
