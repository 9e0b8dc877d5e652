#pragma once
// Phases that were asked for and never began.

#include <string>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

/// A sentence for each of them, with what would make it begin, as the command line names it; usually none.
[[nodiscard]] std::vector<std::string> missing_phases(const Run& run, const Outcome& outcome);

}  // namespace dmoscope
