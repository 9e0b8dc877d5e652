#pragma once
// What holds the minimum of a run where it stands.

#include <functional>
#include <optional>

#include "core/inspect/held_minimum.h"
#include "core/run/run.h"

namespace dmoscope {

struct HoldLook {
  DomainSource domains{};
  std::function<bool()> go_on{};  // see held_minimum(); empty: to the end
  bool at_rest = false;           // nobody has asked: it is not to take long, and holders are drawn
};

/// Of the metric that the run optimises, see held_minimum(). Brings the positions. Throws DeviceError.
[[nodiscard]] std::optional<HeldMinimum> what_holds(const Run& run, ThreadPool* pool, Progress& progress, const HoldLook& look = {});

}  // namespace dmoscope
