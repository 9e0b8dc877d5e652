#include "core/search/parameters.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

void validate(const SearchParameters& parameters) {
  if (parameters.grid_points < 2 || parameters.grid_points > 64)
    throw UsageError(fmt::format("grid points must be 2 to 64, not {}", parameters.grid_points));
  if (parameters.levels < 1 || parameters.levels > 16) throw UsageError(fmt::format("levels must be 1 to 16, not {}", parameters.levels));
  if (!(parameters.omega > 0.0 && parameters.omega <= 2.0))
    throw UsageError(fmt::format("omega must be above 0 and at most 2, not {}", parameters.omega));
  if (parameters.simd && *parameters.simd > best_simd_level())
    throw UsageError(fmt::format("this processor has no {}", name(*parameters.simd)));
}

}  // namespace dmoscope
