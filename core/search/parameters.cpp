#include "core/search/parameters.h"

#include <array>

#include <fmt/format.h>

#include "core/base/unknown_value.h"
#include "core/base/words.h"

namespace dmoscope {

std::string_view name(Precision precision) { return precision == Precision::Float ? "float" : "double"; }

Precision parse_precision(std::string_view word) {
  if (word == "float") return Precision::Float;
  if (word == "double") return Precision::Double;
  throw WrongArguments(unknown_value("precision", word, std::array{name(Precision::Float), name(Precision::Double)}));
}

void validate(const SearchParameters& parameters) {
  if (parameters.grid_points < kLeastGridPoints || parameters.grid_points > kMostGridPoints)
    throw UsageError(fmt::format("grid points must be {} to {}, not {}", kLeastGridPoints, kMostGridPoints, parameters.grid_points));
  if (parameters.levels < kLeastLevels || parameters.levels > kMostLevels)
    throw UsageError(fmt::format("levels must be {} to {}, not {}", kLeastLevels, kMostLevels, parameters.levels));
  if (!(parameters.omega > 0.0 && parameters.omega <= kMostOmega))
    throw UsageError(fmt::format("omega must be above 0 and at most {}, not {}", kMostOmega, parameters.omega));
  if (parameters.simd && *parameters.simd > best_simd_level())
    throw UsageError(fmt::format("this processor has no {}", name(*parameters.simd)));
}

}  // namespace dmoscope
