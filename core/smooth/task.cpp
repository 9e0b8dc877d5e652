#include "core/smooth/task.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

std::string_view name(Directions directions) { return directions == Directions::Random ? "random" : "axes"; }

Directions parse_directions(std::string_view word) {
  for (const Directions directions : {Directions::Random, Directions::Axes})
    if (word == name(directions)) return directions;
  throw UsageError(fmt::format("'{}' names no directions: {} or {}", word, name(Directions::Random), name(Directions::Axes)));
}

void validate(const MethodOptions& options) {
  if (!(options.relaxation > 0.0 && options.relaxation <= 1.0))
    throw UsageError(fmt::format("relaxation must be above 0 and at most 1, not {}", options.relaxation));
}

}  // namespace dmoscope
