#pragma once
// What is told of a run's second aim: of a combination, and of the phase that raises the mean.

#include "app/common/text.h"
#include "core/run/run.h"

namespace dmoscope::app {

/// "combination": what was combined, and for density how local edge lengths went with the target sizes, before and after; "then" and
/// "mean_since" for the second phase. Null where there is no such thing.
void add_composite(Json& object, const Run& run);

/// The same as lines of a summary.
void print_composite(const Run& run);

}  // namespace dmoscope::app
