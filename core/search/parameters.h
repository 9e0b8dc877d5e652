#pragma once
// Parameters of the grid search (paper, Algorithm 2).

#include <optional>
#include <string_view>

#include "core/numeric/simd.h"

namespace dmoscope {

/// The scalar of the search. Its result is confirmed in double before a vertex moves.
enum class Precision { Float, Double };

/// Word of a precision: "float" or "double".
[[nodiscard]] std::string_view name(Precision precision);
/// Parses "float" or "double". Throws UsageError.
[[nodiscard]] Precision parse_precision(std::string_view word);

inline constexpr int kLeastGridPoints = 2, kMostGridPoints = 64, kLeastLevels = 1, kMostLevels = 16;
inline constexpr double kMostOmega = 2.0;

struct SearchParameters {
  int grid_points = 8;  // n: candidates per axis
  int levels = 3;
  double omega = 0.5;  // size of the first grid over the bounding box of the star's other vertices, above 0
  Precision precision = Precision::Float;
  std::optional<SimdLevel> simd{};  // none: the best that this processor has; the result is the same for any
  friend bool operator==(const SearchParameters&, const SearchParameters&) = default;
};

/// Checks the parameters. Throws UsageError that names the parameter and its range.
void validate(const SearchParameters& parameters);

}  // namespace dmoscope
