#pragma once
// Programs of formulas in the form in which lanes run them, step by step.

#include <cstddef>
#include <cstdint>

#include "core/formula/operations.h"
#include "core/formula/program.h"
#include "gpu/lane.h"

namespace dmoscope::gpu {

/// A FormulaProgram as plain data. All pointers are to memory of the device.
struct ProgramCode {
  const FormulaProgram::Constant* constants = nullptr;
  const FormulaProgram::Given *given = nullptr, *varying = nullptr;
  const FormulaStep *beforehand = nullptr, *steps = nullptr;
  const double* prepared = nullptr;  // uniform numbers of a program of FormulaUse::Elements, the same for all elements
  std::uint32_t constant_count = 0, given_count = 0, varying_count = 0, beforehand_count = 0, step_count = 0;
  std::uint16_t uniforms = 0, result = 0, ceiling = kNoCeiling;
  static constexpr std::uint16_t kNoCeiling = 0xffff;
};

/// A lane's registers. Equal registers of all lanes lie side by side.
template <class Real>
struct Registers {
  Real* first;
  std::size_t stride;  // distance from one register to the next
  [[nodiscard]] DMOSCOPE_LANE Real& operator[](std::size_t i) const { return first[i * stride]; }
};

/// Runs a program in one lane.
template <class Real>
class ProgramRun {
 public:
  DMOSCOPE_LANE ProgramRun(const ProgramCode& code, const Real* uniforms, Registers<Real> registers)
      : code_(code), uniforms_(uniforms), registers_(registers) {}

  /// Returns the program's number. varying(input): an input that varies.
  template <class Varying>
  DMOSCOPE_LANE_INLINE DMOSCOPE_LANE Real run(const Varying& varying) const {
    for (std::uint32_t i = 0; i < code_.varying_count; ++i) registers_[code_.varying[i].at] = varying(code_.varying[i].input);
    for (std::uint32_t i = 0; i < code_.step_count; ++i) {
      const FormulaStep step = code_.steps[i];
      operations::with_operation(step.operation, [&]<Operation O>() DMOSCOPE_INLINE_LAMBDA {
        const Real a = number(step.a);
        const Real b = operand_count(O) > 1 ? number(step.b) : Real(0), c = operand_count(O) > 2 ? number(step.c) : Real(0);
        registers_[step.to] = operations::apply_plain<O>(a, b, c);
      });
    }
    return number(code_.result);
  }

 private:
  [[nodiscard]] DMOSCOPE_LANE Real number(std::uint16_t id) const {
    return id < code_.uniforms ? uniforms_[id] : registers_[id - code_.uniforms];
  }

  const ProgramCode& code_;
  const Real* uniforms_;
  Registers<Real> registers_;
};

/// Computes the uniform numbers of a program for one element: see prepare() of core/formula/evaluator.h. given(input): an input that is
/// given.
template <class Real, class Given>
DMOSCOPE_LANE void prepare_numbers(const ProgramCode& code, const Given& given, Real* uniforms) {
  for (std::uint32_t i = 0; i < code.constant_count; ++i) uniforms[code.constants[i].at] = static_cast<Real>(code.constants[i].value);
  for (std::uint32_t i = 0; i < code.given_count; ++i) uniforms[code.given[i].at] = static_cast<Real>(given(code.given[i].input));
  for (std::uint32_t i = 0; i < code.beforehand_count; ++i) {
    const FormulaStep step = code.beforehand[i];
    operations::with_operation(step.operation, [&]<Operation O>() DMOSCOPE_INLINE_LAMBDA {
      uniforms[step.to] = operations::apply_plain<O>(uniforms[step.a], operand_count(O) > 1 ? uniforms[step.b] : Real(0),
                                                     operand_count(O) > 2 ? uniforms[step.c] : Real(0));
    });
  }
}

}  // namespace dmoscope::gpu
