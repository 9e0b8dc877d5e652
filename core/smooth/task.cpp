#include "core/smooth/task.h"

#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope {

std::string_view name(Directions directions) { return directions == Directions::Random ? "random" : "axes"; }

Directions parse_directions(std::string_view word) {
  for (const Directions directions : {Directions::Random, Directions::Axes})
    if (word == name(directions)) return directions;
  throw UsageError(unknown_value("directions", word, std::array{name(Directions::Random), name(Directions::Axes)}));
}

void validate(const MethodOptions& options) {
  if (!(options.relaxation > 0.0 && options.relaxation <= 1.0))
    throw UsageError(fmt::format("relaxation must be above 0 and at most 1, not {}", options.relaxation));
}

}  // namespace dmoscope
