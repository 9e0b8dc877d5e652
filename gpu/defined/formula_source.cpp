#include "gpu/defined/formula_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/formula/operation.h"
#include "gpu/defined/star_search.h"

namespace dmoscope::gpu {

namespace {

/// Limit for the length_of() all programs together.
constexpr std::size_t kMostSteps = 40000;

/// Names of the operations, in the order of Operation.
constexpr std::array<std::string_view, 19> kOperations{
    "Add",         "Subtract", "Multiply", "Divide",     "Minimum",     "Maximum",   "Absolute", "SquareRoot", "CubeRoot", "Less",
    "LessOrEqual", "Equal",    "Select",   "ArcTangent", "Exponential", "Logarithm", "Sine",     "Cosine",     "Power"};
static_assert(kOperations.size() == static_cast<std::size_t>(Operation::Power) + 1);

/// Time to compile a program, in steps as long as an addition.
std::size_t length_of(const FormulaProgram& program) {
  std::size_t length = 0;
  for (const FormulaStep& step : program.steps)
    length += step.operation >= Operation::ArcTangent || step.operation == Operation::CubeRoot ? 20 : 1;
  return length;
}

/// One program as a function of its uniform numbers u and the place `at`.
class FunctionText {
 public:
  explicit FunctionText(const FormulaProgram& program) : program_(program) {}

  [[nodiscard]] std::string write(std::size_t number) const {
    std::string text = fmt::format("__device__ __forceinline__ Real program_{}(const Real* u, const Point& at) {{\n", number);
    for (std::uint16_t i = 0; i < program_.registers; ++i) text += fmt::format("  Real r{};\n", i);
    for (const FormulaProgram::Given& one : program_.varying)
      text += fmt::format("  r{} = at.{};\n", one.at, std::array{"x", "y", "z"}.at(one.input.row));
    for (const FormulaStep& step : program_.steps) text += line(step);
    return text + fmt::format("  return {};\n}}\n", operand(program_.result));
  }

 private:
  [[nodiscard]] std::string line(const FormulaStep& step) const {
    const std::string_view name = kOperations.at(static_cast<std::size_t>(step.operation));
    const int count = operand_count(step.operation);
    const std::string b = count > 1 ? operand(step.b) : "Real(0)", c = count > 2 ? operand(step.c) : "Real(0)";
    return fmt::format("  r{} = operations::apply_plain<Operation::{}>({}, {}, {});\n", step.to, name, operand(step.a), b, c);
  }
  [[nodiscard]] std::string operand(std::uint16_t id) const {
    if (id >= program_.uniforms) return fmt::format("r{}", id - program_.uniforms);
    const auto constant = std::ranges::find(program_.constants, id, &FormulaProgram::Constant::at);
    if (constant != program_.constants.end() && std::isfinite(constant->value)) return fmt::format("Real({:a})", constant->value);
    return fmt::format("u[{}]", id);
  }

  const FormulaProgram& program_;
};

}  // namespace

std::optional<std::string> formula_source(const ProgramTable& table, SearchShape shape) {
  std::string functions, cases;
  std::map<const FormulaProgram*, std::size_t> written;  // groups may share them
  std::size_t length = 0;
  for (std::size_t i = 0; i < table.programs().size(); ++i) {
    const FormulaProgram* program = table.programs()[i];
    if (program == nullptr || program->use != FormulaUse::Places) continue;
    const auto [at, is_new] = written.try_emplace(program, i);
    if (is_new) {
      length += length_of(*program);
      if (length > kMostSteps) return std::nullopt;
      functions += FunctionText(*program).write(i);
    }
    cases += fmt::format("      case {}: return program_{}(u, at);\n", i, at->second);
  }
  const std::string_view real = shape.in_double ? "double" : "float", point = shape.is_volume ? "Vec3Of" : "Vec2";
  return fmt::format(R"(#include "core/formula/operations.h"
#include "gpu/defined/star_search.h"
#include "gpu/defined/warp.h"

namespace dmoscope::gpu {{
using Real = {0};
using Point = {1}<Real>;
{2}
struct Programs {{
  __device__ __forceinline__ Real run(std::size_t program, const Real* u, const Point& at, std::size_t) const {{
    switch (program) {{
{3}      default: return Real(0);
    }}
  }}
}};
}}

extern "C" __global__ void __launch_bounds__({4}) {5}(const __grid_constant__ dmoscope::gpu::StarSearchTask task, std::size_t count) {{
  using namespace dmoscope::gpu;
  const std::size_t i = (std::size_t(blockIdx.x) * {4} + threadIdx.x) / Warp::kSize;
  if (i < count) StarSearch<Real, Point, Programs, Warp>::run(task, Programs(), i, count, Warp());
}}
)",
                     real, point, functions, cases, kFormulaBlock, kFormulaKernel);
}

}  // namespace dmoscope::gpu
