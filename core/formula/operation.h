#pragma once
// The operations that programs are made of.

#include <cstdint>

#include "core/base/host_device.h"

namespace dmoscope {

enum class Operation : std::uint8_t {
  Add,
  Subtract,
  Multiply,
  Divide,  // 0 where the divisor is 0
  Minimum,
  Maximum,
  Absolute,
  SquareRoot,  // of less than 0: 0
  CubeRoot,
  Less,         // 1 or 0
  LessOrEqual,  // likewise
  Equal,        // likewise
  Select,       // where a is not 0 b, else c
  ArcTangent,   // of a over b, as atan2
  Exponential,
  Logarithm,
  Sine,
  Cosine,
  Power  // by logarithm; 0 for what is not above 0
};
/// How many of the operands a, b, c it reads.
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
