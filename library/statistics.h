#pragma once
// The core's statistics as the library's users see them.

#include "core/quality/quality.h"
#include "library/include/dmoscope/quality.h"

namespace dmo {

[[nodiscard]] Statistics statistics_of(const dmoscope::Statistics& statistics);

}  // namespace dmo
