#pragma once
// Parameters of the grid search (paper, Algorithm 2).

#include <optional>

#include "core/search/simd.h"

namespace dmoscope {

/// The scalar the search computes with. Whatever it finds is confirmed in double before a vertex moves.
enum class Precision { Float, Double };

struct SearchParameters {
  int grid_points = 8;  // n: candidates an axis, 2 to 64
  int levels = 3;       // 1 to 16
  double omega = 0.5;   // first grid: this times the bounding box of the star's other vertices, in (0, 2]
  Precision precision = Precision::Float;
  std::optional<SimdLevel> simd{};  // none: the best of this processor; the result is the same for any
  friend bool operator==(const SearchParameters&, const SearchParameters&) = default;
};

/// Throws UsageError that names the parameter and its range.
void validate(const SearchParameters& parameters);

}  // namespace dmoscope
