#include "core/smooth/smoother.h"

#include <array>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/smooth/dmo.h"

namespace dmoscope {

namespace {
constexpr std::array<MethodInfo, 1> kMethods{
    {{"dmo", "Discrete mesh optimization: best candidate of a grid, three levels (Zint and Grosso 2018)"}}};
}

std::span<const MethodInfo> method_table() { return kMethods; }

void require_possible(std::string_view method, const Mesh& mesh, Metric metric, const SearchParameters& parameters) {
  if (method != kMethods[0].name) {
    std::string known;
    for (const MethodInfo& entry : kMethods) known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
    throw UsageError(fmt::format("unknown method '{}'; known are {}", method, known));
  }
  validate(parameters);
  require_defined(metric, mesh);
}

std::unique_ptr<Smoother> make_smoother(std::string_view method, std::shared_ptr<const InputMesh> input,
                                        std::shared_ptr<const Colouring> colouring, Metric metric, const SearchParameters& parameters,
                                        ThreadPool* pool) {
  require_possible(method, input->mesh, metric, parameters);
  return make_dmo_smoother(std::move(input), std::move(colouring), metric, parameters, pool);
}

}  // namespace dmoscope
