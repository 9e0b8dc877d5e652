#include "core/formula/evaluator.h"

#include "core/formula/operations.h"

namespace dmoscope {

// Kernels, each defined in the file of its name.
void formula_kernel_baseline(const FormulaRun<float>& run);
void formula_kernel_baseline(const FormulaRun<double>& run);
void formula_kernel_avx2(const FormulaRun<float>& run);
void formula_kernel_avx2(const FormulaRun<double>& run);
void formula_kernel_avx512(const FormulaRun<float>& run);
void formula_kernel_avx512(const FormulaRun<double>& run);

template <class Real>
FormulaKernel<Real> formula_kernel(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return formula_kernel_avx512;
  if (level == SimdLevel::Avx2) return formula_kernel_avx2;
#endif
  (void)level;
  return formula_kernel_baseline;
}
template FormulaKernel<float> formula_kernel<float>(SimdLevel);
template FormulaKernel<double> formula_kernel<double>(SimdLevel);

template <class Real>
void run_beforehand(const FormulaProgram& program, Real* uniforms) {
  for (const FormulaStep& step : program.beforehand) {
    const Real a = uniforms[step.a], b = uniforms[step.b], c = uniforms[step.c];
    Real& to = uniforms[step.to];
    operations::with_operation(step.operation, [&]<Operation O>() { to = operations::apply_plain<O>(a, b, c); });
  }
}
template void run_beforehand<float>(const FormulaProgram&, float*);
template void run_beforehand<double>(const FormulaProgram&, double*);

}  // namespace dmoscope
