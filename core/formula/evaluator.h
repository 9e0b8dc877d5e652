#pragma once
// Evaluation of programs for many places or elements at once, with the vector instructions of the processor. The result does not depend on
// them.

#include <cstddef>
#include <vector>

#include "core/formula/program.h"
#include "core/numeric/simd.h"

namespace dmoscope {

/// Number of values in a register.
inline constexpr std::size_t kFormulaBatch = 64;

/// Arguments of a kernel. Real: float or double.
template <class Real>
struct FormulaRun {
  const FormulaStep* steps;
  std::size_t step_count;
  const Real* uniforms;  // values of operands below `uniform_count`
  std::size_t uniform_count;
  Real* registers;    // registers of kFormulaBatch values each, aligned for any pack
  std::size_t count;  // number of values, up to kFormulaBatch
};
template <class Real>
using FormulaKernel = void (*)(const FormulaRun<Real>& run);
/// The kernel that runs the steps. `level`: one of supported_simd_levels().
template <class Real>
[[nodiscard]] FormulaKernel<Real> formula_kernel(SimdLevel level);

/// Array of numbers, aligned for any pack.
template <class Real>
class AlignedNumbers {
 public:
  /// Makes room for `count` numbers; the contents are lost if it grows.
  Real* reserve(std::size_t count) {
    if (room_.size() < count + kSlack) room_.resize(count + kSlack);
    const auto address = reinterpret_cast<std::uintptr_t>(room_.data());
    return room_.data() + ((kAlignment - address % kAlignment) % kAlignment) / sizeof(Real);
  }

 private:
  static constexpr std::size_t kAlignment = 64, kSlack = kAlignment / sizeof(Real);
  std::vector<Real> room_;
};

/// Computes the uniform numbers of a program for one element: those given, constants, and what follows from these. given(input): its
/// number. `uniforms`: room for program.uniforms numbers.
template <class Real, class Given>
void prepare(const FormulaProgram& program, const Given& given, Real* uniforms);
/// Runs the program's steps on uniform numbers.
template <class Real>
void run_beforehand(const FormulaProgram& program, Real* uniforms);

/// The result of a run: `count` values, or one value for all.
template <class Real>
class FormulaResult {
 public:
  FormulaResult(const FormulaProgram& program, const Real* uniforms, const Real* registers)
      : values_(program.result < program.uniforms
                    ? uniforms + program.result
                    : registers + static_cast<std::size_t>(program.result - program.uniforms) * kFormulaBatch),
        stride_(program.result < program.uniforms ? 0 : 1) {}
  [[nodiscard]] Real operator[](std::size_t i) const { return values_[i * stride_]; }
  /// Values of places, if each place has one of its own.
  [[nodiscard]] const Real* values() const { return values_; }

 private:
  const Real* values_;
  std::size_t stride_;
};

template <class Real, class Given>
void prepare(const FormulaProgram& program, const Given& given, Real* uniforms) {
  for (const FormulaProgram::Constant& constant : program.constants) uniforms[constant.at] = static_cast<Real>(constant.value);
  for (const FormulaProgram::Given& one : program.given) uniforms[one.at] = static_cast<Real>(given(one.input));
  run_beforehand(program, uniforms);
}

}  // namespace dmoscope
