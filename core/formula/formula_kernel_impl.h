#pragma once
// The single definition of the evaluator's kernel. Only the formula_kernel_*.cpp, each compiled for one kind of processor, include it;
// core/smooth/kernels/lane_kernel_impl.h has the rules for such code.

#include <type_traits>

#include "core/numeric/pack.h"
// Included after the packs, whose functions they use.
#include "core/formula/evaluator.h"
#include "core/formula/operations.h"

namespace dmoscope::formula_kernels {

/// Operations that a pack of floats computes in double, as a float does.
template <Operation O>
inline constexpr bool kInDouble = O == Operation::CubeRoot || O == Operation::ArcTangent;

/// Kernel for packs. R: the pack; D: the pack of doubles.
template <class R, class D, class Real>
class Kernel {
 public:
  explicit Kernel(const FormulaRun<Real>& run) : run_(run) {}

  void run() const {
    for (std::size_t i = 0; i < run_.step_count; ++i) {
      const FormulaStep& step = run_.steps[i];
      const Operand a = operand(step.a), b = operand(step.b), c = operand(step.c);
      Real* to = run_.registers + step.to * kFormulaBatch;
      operations::with_operation(step.operation, [&]<Operation O>() { apply<O>(a, b, c, to); });
    }
  }

 private:
  static constexpr std::size_t kWidth = R::size;
  /// An operand: a register, or a number that is equal for all values, and its pack.
  struct Operand {
    const Real* at;
    R same;
    [[nodiscard]] Real slot(std::size_t i) const { return at != nullptr ? at[i] : same.get(0); }
  };

  [[nodiscard]] Operand operand(std::size_t id) const {
    if (id >= run_.uniform_count) return {run_.registers + (id - run_.uniform_count) * kFormulaBatch, R(Real(0))};
    return {nullptr, R(run_.uniforms[id])};
  }

  template <Operation O>
  void apply(const Operand& a, const Operand& b, const Operand& c, Real* to) const {
    const std::size_t count = run_.count;
    if constexpr (operations::kSlotBySlot<O>) {
      for (std::size_t k = 0; k < count; ++k)
        to[k] = static_cast<Real>(operations::apply_alone(O, static_cast<double>(a.slot(k)), static_cast<double>(b.slot(k))));
    } else if constexpr (kInDouble<O> && !std::is_same_v<R, D>) {
      for (std::size_t i = 0; i < count; i += kWidth) apply_in_double<O>(a, b, i, to);
    } else if constexpr (operand_count(O) == 1) {
      for (std::size_t i = 0; i < count; i += kWidth) step<O>(R::load_aligned(a.at + i), R(Real(0)), R(Real(0)), to + i);
    } else if constexpr (operand_count(O) == 2) {
      // Decides once, and not pack by pack, which operands vary.
      if (a.at != nullptr && b.at != nullptr) {
        for (std::size_t i = 0; i < count; i += kWidth) step<O>(R::load_aligned(a.at + i), R::load_aligned(b.at + i), R(Real(0)), to + i);
      } else if (a.at != nullptr) {
        for (std::size_t i = 0; i < count; i += kWidth) step<O>(R::load_aligned(a.at + i), b.same, R(Real(0)), to + i);
      } else {
        for (std::size_t i = 0; i < count; i += kWidth) step<O>(a.same, R::load_aligned(b.at + i), R(Real(0)), to + i);
      }
    } else {
      const auto pack = [](const Operand& one, std::size_t i) { return one.at != nullptr ? R::load_aligned(one.at + i) : one.same; };
      for (std::size_t i = 0; i < count; i += kWidth) step<O>(pack(a, i), pack(b, i), pack(c, i), to + i);
    }
  }

  template <Operation O>
  static void step(R a, R b, R c, Real* to) {
    operations::apply<O>(a, b, c).store_aligned(to);
  }

  template <Operation O>
  static void apply_in_double(const Operand& a, const Operand& b, std::size_t i, Real* to) {
    alignas(64) double x[kWidth], y[kWidth];
    for (std::size_t k = 0; k < kWidth; ++k) {
      x[k] = static_cast<double>(a.slot(i + k));
      y[k] = operand_count(O) > 1 ? static_cast<double>(b.slot(i + k)) : 0.0;
    }
    for (std::size_t k = 0; k < kWidth; k += D::size)
      operations::apply<O>(D::load_aligned(x + k), D::load_aligned(y + k), D(0.0)).store_aligned(x + k);
    for (std::size_t k = 0; k < kWidth; ++k) to[i + k] = static_cast<Real>(x[k]);
  }

  const FormulaRun<Real>& run_;
};

}  // namespace dmoscope::formula_kernels
