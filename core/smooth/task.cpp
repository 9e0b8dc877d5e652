#include "core/smooth/task.h"

#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope {

namespace {
constexpr std::array<std::string_view, 2> kDirections{"random", "axes"};  // in the order of Directions
}

std::string_view name(Directions directions) { return kDirections[static_cast<std::size_t>(directions)]; }
Directions parse_directions(std::string_view word) { return parse_choice<Directions>("directions", word, kDirections); }

void validate(const MethodOptions& options) {
  if (!(options.relaxation > 0.0 && options.relaxation <= 1.0))
    throw UsageError(fmt::format("relaxation must be above 0 and at most 1, not {}", options.relaxation));
}

}  // namespace dmoscope
