#include "core/formula/operations.h"

namespace dmoscope::operations {

double apply_alone(Operation operation, double a, double b) {
  switch (operation) {
    case Operation::Exponential:
      return elementary::exponential(a);
    case Operation::Logarithm:
      return elementary::logarithm(a);
    case Operation::Sine:
      return elementary::sine(a);
    case Operation::Cosine:
      return elementary::cosine(a);
    case Operation::Power:
      return elementary::power(a, b);
    default:
      break;
  }
  double value = 0.0;
  with_operation(operation, [&]<Operation O>() { value = apply<O>(a, b, 0.0); });
  return value;
}

}  // namespace dmoscope::operations
