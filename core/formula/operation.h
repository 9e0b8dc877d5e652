#pragma once
// Operations of a formula's program.

#include <cstdint>

#include "core/base/host_device.h"

namespace dmoscope {

enum class Operation : std::uint8_t {
  Add,
  Subtract,
  Multiply,
  Divide,  // 0 if the divisor is 0
  Minimum,
  Maximum,
  Absolute,
  SquareRoot,  // 0 if the operand is negative
  CubeRoot,
  Less,         // result 1 or 0
  LessOrEqual,  // result 1 or 0
  Equal,        // result 1 or 0
  Select,       // b if a is not 0, else c
  ArcTangent,   // atan2 of a and b
  Exponential,
  Logarithm,
  Sine,
  Cosine,
  Power  // computed by logarithm; 0 unless the base is positive
};
/// Number of operands that it reads, of a, b, c.
[[nodiscard]] DMOSCOPE_ANYWHERE int operand_count(Operation operation) {
  switch (operation) {
    case Operation::Absolute:
    case Operation::SquareRoot:
    case Operation::CubeRoot:
    case Operation::Exponential:
    case Operation::Logarithm:
    case Operation::Sine:
    case Operation::Cosine:
      return 1;
    case Operation::Select:
      return 3;
    default:
      return 2;
  }
}

}  // namespace dmoscope
