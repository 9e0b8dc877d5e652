#pragma once
// Check that every register is written before something is computed with it.

#include <optional>
#include <string>

#include "tests/gpu/ptx/lane.h"

namespace dmoscope::gpu::ptx {

/// The text of the first reachable instruction that computes with, branches on, or addresses by a register not yet written; none if there
/// is none. Registers that were not written may be copied, as the gaps of a structure are.
[[nodiscard]] std::optional<std::string> read_before_written(const Entry& entry);

}  // namespace dmoscope::gpu::ptx
