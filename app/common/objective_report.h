#pragma once
// What is reported of a run's second aim: a combination, or the phase that raises the mean.

#include "app/common/text.h"
#include "core/run/run.h"

namespace dmoscope::app {

/// "combination": what was combined, and for density how well local edge lengths follow the target sizes, before and after; "then" and
/// "mean_since" for the second phase. Null where there is no such thing.
void add_composite(Json& object, const Run& run);

/// The same as lines of a summary.
void print_composite(const Run& run);

}  // namespace dmoscope::app
