#include "ui/analysis/metric_choices.h"

#include <algorithm>

#include "core/quality/defined_metric.h"
#include "core/target/target_table.h"

namespace dmoscope::ui {

namespace {

bool fits(Metric metric, const Mesh& mesh) {
  const auto kinds = mesh.elements.kinds();
  bool present[kElementKindCount] = {};
  for (const ElementKind kind : kinds) present[static_cast<std::size_t>(kind)] = true;
  for (std::size_t k = 0; k < kElementKindCount; ++k)
    if (present[k] && !info(metric).defined_for(static_cast<ElementKind>(k))) return false;
  return true;
}

}  // namespace

std::vector<Metric> further_metrics(const SessionView& session) {
  std::vector<Metric> metrics;
  const auto add = [&](Metric metric) {
    if (!is_built_in(metric) && std::ranges::find(metrics, metric) == metrics.end()) metrics.push_back(metric);
  };
  if (!session.input) return metrics;
  for (const NamedFormula& named : named_formulas())
    if (const Metric metric = parse_metric(named.name); fits(metric, session.input->mesh)) add(metric);
  if (session.active < session.runs.size()) {
    const Metric active = session.runs[session.active].parameters.metric;
    if (const Target target = target_of(active); !target.is_ideal()) {
      add(with_target(Metric::MeanRatio, target));
      for (const NamedFormula& named : named_formulas()) add(with_target(parse_metric(named.name), target));
    }
    add(active);
  }
  for (const RunView& run : session.runs)
    if (run.input == session.input) add(run.parameters.metric);
  add(session.shown);
  return metrics;
}

std::vector<TargetChoice> target_choices(const InputMesh& input) {
  std::vector<TargetChoice> choices{
      {"ideal", "ideal elements", "equal edges, right corners: the shape that the metric itself rates best"},
      {"input", "as they were", "every element keeps the shape that it had in the input"},
      {"input:3", "their input shapes, averaged over neighbours", "three rounds of averaging over the neighbours, which removes noise"}};
  const bool volume = input.is_volume();
  const auto kinds = input.mesh.elements.kinds();
  const bool may_have_layers = std::ranges::any_of(kinds, [](ElementKind kind) {
    return kind == ElementKind::Quadrilateral || kind == ElementKind::Hexahedron || kind == ElementKind::Wedge;
  });
  if (may_have_layers)
    choices.push_back({"layers:input", "boundary layers kept",
                       "stacks of stretched elements on the boundary keep their shapes, to 5 % of their aspect; all others ideal"});
  const auto is_metric = [&](const Field& field) { return is_metric_field(field, volume ? 3 : 2); };
  if (std::ranges::count_if(input.mesh.fields, is_metric) == 1)
    choices.push_back({"field", "the metric field", "unit size in the metric tensors of the file"});
  else
    for (const Field& field : input.mesh.fields)
      if (is_metric(field))
        choices.push_back({to_text(Target{{}, {.kind = TargetShape::Kind::Field, .field = field.name}}), "metric field " + field.name,
                           "unit size in the metric tensors of the file"});
  for (const Group& group : input.mesh.groups)
    if (group.of_elements() && !group.name.empty() && group.name.find('"') == std::string::npos && choices.size() < 20)
      choices.push_back({to_text(Target{{{group.name, {.kind = TargetShape::Kind::Input, .tolerance = kKeptTolerance}}}, {}}),
                         group.name + " kept", "the elements of this group keep their input shapes, all others ideal"});
  return choices;
}

}  // namespace dmoscope::ui
