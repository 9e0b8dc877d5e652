#pragma once
// Evaluation of a formula's program on numbers that carry derivatives (core/numeric/dual.h, second_dual.h), one element at a time, and on
// plain numbers with the same bits.

#include <span>
#include <type_traits>
#include <vector>

#include "core/formula/operations.h"
#include "core/formula/program.h"
#include "core/numeric/dual.h"
#include "core/numeric/second_dual.h"

namespace dmoscope {

namespace dual_program {

/// Applies a function to a by the chain rule: `f`, `slope` and `bend` are its value, first and second derivative there.
template <class Gradient>
[[nodiscard]] DualOf<Gradient> through(const DualOf<Gradient>& a, double f, double slope, double /*bend*/) {
  return a.through(f, slope);
}
template <std::size_t N>
[[nodiscard]] SecondDual<N> through(const SecondDual<N>& a, double f, double slope, double bend) {
  return a.through(f, slope, bend);
}

/// The logarithm of a positive number.
template <class R>
[[nodiscard]] R logarithm(const R& a) {
  return through(a, elementary::logarithm(a.value), 1.0 / a.value, -1.0 / (a.value * a.value));
}

/// An operation on numbers with derivatives. At a kink, the derivatives are those of the branch that it takes.
template <Operation O, class R>
[[nodiscard]] R apply(const R& a, [[maybe_unused]] const R& b, [[maybe_unused]] const R& c) {
  [[maybe_unused]] const double x = a.value;
  if constexpr (O == Operation::Exponential) {
    const double e = elementary::exponential(x);
    return through(a, e, e, e);
  } else if constexpr (O == Operation::Logarithm) {
    return x > 0.0 ? logarithm(a) : R(elementary::logarithm(x));
  } else if constexpr (O == Operation::Sine || O == Operation::Cosine) {
    const double sine = elementary::sine(x), cosine = elementary::cosine(x);
    return O == Operation::Sine ? through(a, sine, cosine, -sine) : through(a, cosine, -sine, -cosine);
  } else if constexpr (O == Operation::Power) {
    if (!(x > 0.0)) return R(0.0);
    const double power = elementary::power(x, b.value);
    return through(b * logarithm(a), power, power, power);
  } else {
    return operations::apply<O>(a, b, c);
  }
}

}  // namespace dual_program

/// The result of a program of FormulaUse::Elements. R: double, DualOf or SecondDual. given(input): its number, as R. `room`: working
/// memory, kept from one call to the next.
template <class R, class Given>
[[nodiscard]] R run_program(const FormulaProgram& program, const Given& given, std::vector<R>& room) {
  const std::size_t uniforms = program.uniforms;
  if (room.size() < uniforms + program.registers) room.resize(uniforms + program.registers);
  for (const FormulaProgram::Constant& constant : program.constants) room[constant.at] = R(constant.value);
  for (const FormulaProgram::Given& one : program.given) room[one.at] = given(one.input);
  for (const FormulaProgram::Given& one : program.varying) room[uniforms + one.at] = given(one.input);
  const auto run = [&room](std::span<const FormulaStep> steps, std::size_t first) {
    for (const FormulaStep& step : steps)
      operations::with_operation(step.operation, [&]<Operation O>() {
        if constexpr (std::is_same_v<R, double>)
          room[first + step.to] = operations::apply_plain<O>(room[step.a], room[step.b], room[step.c]);
        else
          room[first + step.to] = dual_program::apply<O>(room[step.a], room[step.b], room[step.c]);
      });
  };
  run(program.beforehand, 0);
  run(program.steps, uniforms);
  return room[program.result];
}

}  // namespace dmoscope
