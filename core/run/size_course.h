#pragma once
// Agreement of a run's element sizes with its size function, now and at the input.

#include "core/run/run.h"
#include "core/smooth/size_field.h"

namespace dmoscope {

/// Size correlations of the free vertices. NaN where there is no size function, or the same size everywhere.
struct SizeCourse {
  SizeCorrelation before, after;
  [[nodiscard]] bool known() const noexcept { return after.sizes == after.sizes; }
};

/// Size correlation at the input of a run with a size function.
[[nodiscard]] SizeCorrelation size_correlation_at_input(const Run& run);
/// Size correlations of any run, at the input and in its present state. Throws DeviceError.
[[nodiscard]] SizeCourse size_course_of(const Run& run);

}  // namespace dmoscope
