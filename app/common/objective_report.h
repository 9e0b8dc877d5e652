#pragma once
// Report of a run's second aim: a combination, or the phase that raises the mean.

#include "app/common/text.h"
#include "core/run/run.h"

namespace dmoscope::app {

/// Adds "combination": its terms, and for density how well local edge lengths follow the target sizes, before and after; and "then" and
/// "mean_since" for the second phase. Null if the run has no such aim.
void add_composite(Json& object, const Run& run);

/// Prints the second aim as lines of a summary.
void print_composite(const Run& run);

}  // namespace dmoscope::app
