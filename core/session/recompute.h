#pragma once
// Recomputation of positions that a run's history no longer keeps.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/session/session.h"

namespace dmoscope {

/// The positions at the end of a recorded iteration: those kept, or else the same bits recomputed from the nearest kept ones by another
/// run, so that this one stays at its moment. Asks `go_on` every 100 ms or so; none once that returns false. Throws Error.
[[nodiscard]] std::optional<std::vector<Vec3>> positions_at(const Session& session, const Run& run, std::uint64_t iteration,
                                                            const std::function<bool()>& go_on);

}  // namespace dmoscope
