#pragma once
// The one definition of the evaluator's kernel. Only the formula_kernel_*.cpp, each compiled for one kind of processor, include it: see
// core/smooth/kernels/lane_kernel_impl.h for what that asks of the code.

#include <type_traits>

#include "core/numeric/pack.h"
// After the packs:
#include "core/formula/evaluator.h"
#include "core/formula/operations.h"

namespace dmoscope::formula_kernels {

/// Those that a pack of floats does by way of doubles, as a float does.
template <Operation O>
inline constexpr bool kInDouble = O == Operation::CubeRoot || O == Operation::ArcTangent;

/// R: the pack; D: that of doubles.
template <class R, class D, class Real>
class Kernel {
 public:
  explicit Kernel(const FormulaRun<Real>& run) : run_(run) {}

  void run() {
    for (std::size_t i = 0; i < run_.step_count; ++i) {
      const FormulaStep& step = run_.steps[i];
      const Operand a = operand(step.a, 0), b = operand(step.b, 1), c = operand(step.c, 2);
      Real* to = run_.registers + step.to * kFormulaBatch;
      operations::with_operation(step.operation, [&]<Operation O>() { apply<O>(a, b, c, to); });
    }
  }

 private:
  static constexpr std::size_t kWidth = R::size;
  /// A register, or a pack of the same number that all of a register's packs are.
  struct Operand {
    const Real* at;
    std::size_t mask;
  };

  Operand operand(std::size_t id, std::size_t which) {
    if (id >= run_.uniform_count) return {run_.registers + (id - run_.uniform_count) * kFormulaBatch, ~std::size_t{0}};
    R(run_.uniforms[id]).store_aligned(same_[which]);
    return {same_[which], 0};
  }

  template <Operation O>
  void apply(Operand a, Operand b, Operand c, Real* to) {
    for (std::size_t i = 0; i < run_.count; i += kWidth) {
      if constexpr (operations::kSlotBySlot<O>) {
        for (std::size_t k = i; k < i + kWidth; ++k)
          to[k] = static_cast<Real>(
              operations::apply_alone(O, static_cast<double>(a.at[a.mask == 0 ? 0 : k]), static_cast<double>(b.at[b.mask == 0 ? 0 : k])));
      } else if constexpr (kInDouble<O> && !std::is_same_v<R, D>) {
        alignas(64) double x[kWidth], y[kWidth];
        for (std::size_t k = 0; k < kWidth; ++k) {
          x[k] = static_cast<double>(a.at[(i & a.mask) + k]);
          y[k] = static_cast<double>(b.at[(i & b.mask) + k]);
        }
        for (std::size_t k = 0; k < kWidth; k += D::size)
          operations::apply<O>(D::load_aligned(x + k), D::load_aligned(y + k), D(0.0)).store_aligned(x + k);
        for (std::size_t k = 0; k < kWidth; ++k) to[i + k] = static_cast<Real>(x[k]);
      } else {
        operations::apply<O>(R::load_aligned(a.at + (i & a.mask)), R::load_aligned(b.at + (i & b.mask)),
                             R::load_aligned(c.at + (i & c.mask)))
            .store_aligned(to + i);
      }
    }
  }

  const FormulaRun<Real>& run_;
  alignas(64) Real same_[3][kWidth];
};

}  // namespace dmoscope::formula_kernels
