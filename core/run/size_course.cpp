#include "core/run/size_course.h"

namespace dmoscope {

SizeCorrelation size_correlation_at_input(const Run& run) {
  return size_correlation(*run.size_field(), run.input(), run.input().mesh.positions, run.colouring().order);
}

SizeCourse size_course_of(const Run& run) {
  if (!run.size_field()) return {};
  return {size_correlation_at_input(run), size_correlation(*run.size_field(), run.input(), run.positions(), run.colouring().order)};
}

}  // namespace dmoscope
