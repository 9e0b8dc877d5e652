#pragma once
// Results of the operations of formulas, for any scalar: a plain number, or a pack whose slots get the bits that plain numbers get.

#include "core/formula/operation.h"
#include "core/numeric/elementary.h"
#include "core/numeric/scalar.h"

namespace dmoscope::operations {

/// Operations that have no case here and run slot by slot: see apply_alone().
template <Operation O>
inline constexpr bool kSlotBySlot =
    O == Operation::Exponential || O == Operation::Logarithm || O == Operation::Sine || O == Operation::Cosine || O == Operation::Power;

/// Result for plain numbers, in double. For kernels that are compiled for one kind of processor: they must not compile a copy of these.
[[nodiscard]] double apply_alone(Operation operation, double a, double b);

/// Result for a scalar, with the `cube_root` and `atan2` that belong to it.
template <Operation O, class R>
[[gnu::always_inline]] DMOSCOPE_ANYWHERE R apply(R a, R b, R c) {
  using scalar::abs, scalar::atan2, scalar::cube_root, scalar::select, scalar::sqrt;
  if constexpr (O == Operation::Add) return a + b;
  if constexpr (O == Operation::Subtract) return a - b;
  if constexpr (O == Operation::Multiply) return a * b;
  if constexpr (O == Operation::Divide) {
    const auto none = b == R(0);
    return select(none, R(0), a / select(none, R(1), b));
  }
  // Selections instead of min() and max(), in which processors differ for NaN: something may have overflowed.
  if constexpr (O == Operation::Minimum) return select(a < b, a, b);
  if constexpr (O == Operation::Maximum) return select(a > b, a, b);
  if constexpr (O == Operation::Absolute) return abs(a);
  if constexpr (O == Operation::SquareRoot) return sqrt(select(a > R(0), a, R(0)));
  if constexpr (O == Operation::CubeRoot) return cube_root(a);
  if constexpr (O == Operation::Less) return select(a < b, R(1), R(0));
  if constexpr (O == Operation::LessOrEqual) return select(a <= b, R(1), R(0));
  if constexpr (O == Operation::Equal) return select(a == b, R(1), R(0));
  if constexpr (O == Operation::Select) return select(a == R(0), c, b);
  if constexpr (O == Operation::ArcTangent) return atan2(a, b);
  return R(0);
}

/// Result of any operation for plain numbers.
template <Operation O, class Real>
[[nodiscard]] DMOSCOPE_ANYWHERE Real apply_plain(Real a, [[maybe_unused]] Real b, [[maybe_unused]] Real c) {
  if constexpr (O == Operation::Exponential) return static_cast<Real>(elementary::exponential(static_cast<double>(a)));
  if constexpr (O == Operation::Logarithm) return static_cast<Real>(elementary::logarithm(static_cast<double>(a)));
  if constexpr (O == Operation::Sine) return static_cast<Real>(elementary::sine(static_cast<double>(a)));
  if constexpr (O == Operation::Cosine) return static_cast<Real>(elementary::cosine(static_cast<double>(a)));
  if constexpr (O == Operation::Power) return static_cast<Real>(elementary::power(static_cast<double>(a), static_cast<double>(b)));
  if constexpr (!kSlotBySlot<O>) return apply<O>(a, b, c);
}

/// Calls f.template operator()<O>() with the operation as template argument.
template <class F>
[[gnu::always_inline]] DMOSCOPE_ANYWHERE void with_operation(Operation operation, const F& f) {
  switch (operation) {
#define DMOSCOPE_OPERATION(name) \
  case Operation::name:          \
    return f.template operator()<Operation::name>()
    DMOSCOPE_OPERATION(Add);
    DMOSCOPE_OPERATION(Subtract);
    DMOSCOPE_OPERATION(Multiply);
    DMOSCOPE_OPERATION(Divide);
    DMOSCOPE_OPERATION(Minimum);
    DMOSCOPE_OPERATION(Maximum);
    DMOSCOPE_OPERATION(Absolute);
    DMOSCOPE_OPERATION(SquareRoot);
    DMOSCOPE_OPERATION(CubeRoot);
    DMOSCOPE_OPERATION(Less);
    DMOSCOPE_OPERATION(LessOrEqual);
    DMOSCOPE_OPERATION(Equal);
    DMOSCOPE_OPERATION(Select);
    DMOSCOPE_OPERATION(ArcTangent);
    DMOSCOPE_OPERATION(Exponential);
    DMOSCOPE_OPERATION(Logarithm);
    DMOSCOPE_OPERATION(Sine);
    DMOSCOPE_OPERATION(Cosine);
    DMOSCOPE_OPERATION(Power);
#undef DMOSCOPE_OPERATION
  }
}

}  // namespace dmoscope::operations
