#include "core/formula/formula_kernel_impl.h"

namespace dmoscope {

void formula_kernel_baseline(const FormulaRun<float>& run);
void formula_kernel_baseline(const FormulaRun<double>& run);

void formula_kernel_baseline(const FormulaRun<float>& run) { formula_kernels::Kernel<Pack<float>, Pack<double>, float>(run).run(); }
void formula_kernel_baseline(const FormulaRun<double>& run) { formula_kernels::Kernel<Pack<double>, Pack<double>, double>(run).run(); }

}  // namespace dmoscope
