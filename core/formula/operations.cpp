#include "core/formula/operations.h"

namespace dmoscope::operations {

double apply_alone(Operation operation, double a, double b) {
  double value = 0.0;
  with_operation(operation, [&]<Operation O>() { value = apply_plain<O>(a, b, 0.0); });
  return value;
}

}  // namespace dmoscope::operations
