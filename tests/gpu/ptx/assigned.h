#pragma once
// Is every register written before something is computed with it?

#include <optional>
#include <string>

#include "tests/gpu/ptx/lane.h"

namespace dmoscope::gpu::ptx {

/// The text of the first instruction that can be reached with a register not yet written that it computes with, decides by, or takes for an
/// address; nothing where there is none. What was not written may be passed on: the gaps of a structure are.
[[nodiscard]] std::optional<std::string> read_before_written(const Entry& entry);

}  // namespace dmoscope::gpu::ptx
