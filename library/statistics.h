#pragma once
// The core's statistics in the library's form.

#include "core/quality/quality.h"
#include "library/include/dmoscope/quality.h"

namespace dmo {

[[nodiscard]] Statistics statistics_of(const dmoscope::Statistics& statistics);

}  // namespace dmo
