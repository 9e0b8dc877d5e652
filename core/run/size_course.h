#pragma once
// How well the elements of a run have the sizes that it aims at, and had them at the input.

#include "core/run/run.h"
#include "core/smooth/size_field.h"

namespace dmoscope {

/// Of the free vertices. NaN where there is no size function, or the same size everywhere.
struct SizeCourse {
  SizeCorrelation before, after;
  [[nodiscard]] bool known() const noexcept { return after.sizes == after.sizes; }
};

/// Of a run with a size function, at the input.
[[nodiscard]] SizeCorrelation size_correlation_at_input(const Run& run);
/// Of any run, at the input and where it stands. Throws DeviceError.
[[nodiscard]] SizeCourse size_course_of(const Run& run);

}  // namespace dmoscope
