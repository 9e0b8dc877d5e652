#include "core/quality/formula_values.h"

namespace dmoscope {

namespace {
/// Kept: judging allocates nothing.
struct Room {
  AlignedNumbers<double> uniforms, registers;
};
Room& room() {
  thread_local Room room;
  return room;
}
}  // namespace

FormulaValues::FormulaValues(const FormulaProgram& program)
    : program_(program),
      uniforms_(room().uniforms.reserve(program.uniforms)),
      registers_(room().registers.reserve(std::size_t{program.registers} * kFormulaBatch)) {}

void FormulaValues::run() {
  static const FormulaKernel<double> kernel = formula_kernel<double>(best_simd_level());
  kernel({program_.steps.data(), program_.steps.size(), uniforms_, program_.uniforms, registers_, count_});
}

}  // namespace dmoscope
