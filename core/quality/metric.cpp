#include "core/quality/metric.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/quality/defined_metric.h"
#include "core/quality/formulas.h"

namespace dmoscope {

namespace {
template <Metric M>
constexpr KindSet kinds_of() {
  using namespace formulas;
  KindSet kinds{};
  const auto add = [&](bool defined, ElementKind kind) { kinds = static_cast<KindSet>(kinds | (defined ? kind_set(kind) : KindSet{})); };
  add(kDefinedForTriangles<M, Vec2<double>>, ElementKind::Triangle);
  add(kDefinedForQuadrilaterals<M, Vec2<double>>, ElementKind::Quadrilateral);
  add(kDefinedForTetrahedra<M>, ElementKind::Tetrahedron);
  for (const ElementKind kind : {ElementKind::Hexahedron, ElementKind::Wedge, ElementKind::Pyramid}) add(kDefinedForCorners<M>, kind);
  return kinds;
}

template <std::size_t I>
constexpr MetricInfo row() {
  constexpr Metric kMetric = static_cast<Metric>(I);
  MetricInfo result = formulas::Formula<kMetric>::kInfo;
  result.kinds = kinds_of<kMetric>();
  return result;
}
constexpr auto kTable = []<std::size_t... I>(std::index_sequence<I...>) { return std::array{row<I>()...}; }
(std::make_index_sequence<kMetricCount>{});
static_assert(std::ranges::all_of(kTable, [](const MetricInfo& entry) {
  return &entry - kTable.data() == static_cast<std::ptrdiff_t>(entry.metric);
}));
}  // namespace

std::span<const MetricInfo> metric_table() { return kTable; }

const MetricInfo& info(Metric metric) { return is_built_in(metric) ? kTable[static_cast<std::size_t>(metric)] : defined(metric).info; }

Metric parse_metric(std::string_view name) {
  for (const MetricInfo& entry : kTable)
    if (entry.name == name) return entry.metric;
  if (const auto known = define_metric(name)) return *known;
  std::vector<std::string_view> names;
  for (const MetricInfo& entry : kTable) names.push_back(entry.name);
  for (const NamedFormula& entry : named_formulas()) names.push_back(entry.name);
  throw UsageError(unknown_value("metric", name, names) + "; or formula:TEXT");
}

void refuse_defined_metric() { throw std::logic_error("a metric that is defined by a formula or a target has no code of its own"); }

void require_defined(Metric metric, const Mesh& mesh) {
  for (const ElementKind kind : {ElementKind::Triangle, ElementKind::Quadrilateral, ElementKind::Tetrahedron, ElementKind::Hexahedron,
                                 ElementKind::Wedge, ElementKind::Pyramid}) {
    if (info(metric).defined_for(kind)) continue;
    if (const auto count = std::ranges::count(mesh.elements.kinds(), kind); count > 0)
      throw UsageError(fmt::format("{} is not defined for {}, and the mesh has {} of them", info(metric).name, info(kind).plural, count));
  }
}

}  // namespace dmoscope
