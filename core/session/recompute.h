#pragma once
// Computes positions again that a run's history no longer keeps.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/session/session.h"

namespace dmoscope {

/// Where the vertices were at the end of a recorded iteration: the kept positions, else computed again from the nearest kept ones by
/// another run, the same bits, so that this one stays where it stands. Asks `go_on` every 100 ms or so; none once it says no. Throws Error.
[[nodiscard]] std::optional<std::vector<Vec3>> positions_at(const Session& session, const Run& run, std::uint64_t iteration,
                                                            const std::function<bool()>& go_on);

}  // namespace dmoscope
