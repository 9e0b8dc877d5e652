#pragma once
// What holds the minimum of a run where it stands.

#include <functional>
#include <optional>

#include "core/inspect/held_minimum.h"
#include "core/run/run.h"

namespace dmoscope {

/// Of the metric that the run optimises, see held_minimum(). Brings the positions. Throws Cancelled and DeviceError.
[[nodiscard]] std::optional<HeldMinimum> what_holds(const Run& run, ThreadPool* pool, Progress& progress, const DomainSource& domains = {},
                                                    const std::function<bool()>& go_on = {});

}  // namespace dmoscope
