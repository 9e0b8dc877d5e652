#include "ui/analysis/metric_choices.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quality/defined_metric.h"
#include "core/quality/formula_facts.h"
#include "core/quality/formula_values.h"
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

/// The reference element of a kind, and the place of its last corner.
struct ReferenceElement {
  ElementKind kind;
  std::vector<Vec3> corners;  // corners without the last
  double low_x, low_y, high_x, high_y;
};

const std::array<ReferenceElement, 3>& references() {
  static const double h = 0.5 * std::sqrt(3.0);
  static const std::array<ReferenceElement, 3> all{{
      {ElementKind::Triangle, {{0, 0, 0}, {1, 0, 0}}, -0.7, -0.45, 1.7, 1.35},
      {ElementKind::Quadrilateral, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, -0.9, -0.4, 1.5, 1.4},
      {ElementKind::Tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}}, -0.7, -0.45, 1.7, 1.35},
  }};
  return all;
}

FormulaPicture picture_of(const Formula& formula, const ReferenceElement& reference) {
  constexpr int kColumns = 80, kRows = 60;
  FormulaPicture picture{reference.kind, reference.low_x, reference.low_y, reference.high_x, reference.high_y, kColumns, kRows};
  for (const Vec3& p : reference.corners) picture.corners.emplace_back(p.x, reference.kind == ElementKind::Tetrahedron ? p.z : p.y);
  const FormulaProgram& program = formula.program(reference.kind, FormulaSpace::Plain, FormulaUse::Elements, kNoIndex);
  picture.values.reserve(static_cast<std::size_t>(kColumns * kRows));
  for (int row = 0; row < kRows; ++row)
    for (int first = 0; first < kColumns; first += static_cast<int>(kFormulaBatch)) {
      FormulaValues values(program);
      const int last = std::min(kColumns, first + static_cast<int>(kFormulaBatch));
      for (int column = first; column < last; ++column) {
        const double x = reference.low_x + (reference.high_x - reference.low_x) * (column + 0.5) / kColumns;
        const double y = reference.low_y + (reference.high_y - reference.low_y) * (row + 0.5) / kRows;
        const Vec3 free = reference.kind == ElementKind::Tetrahedron ? Vec3{x, 0.5 / std::sqrt(3.0), y} : Vec3{x, y, 0.0};
        values.set(static_cast<std::size_t>(column - first), [&](const FormulaInput& in) {
          if (in.what == FormulaInput::What::MeanMeasure) return ideal_measure(reference.kind);
          if (in.what == FormulaInput::What::Field) return 1.0;
          if (in.what != FormulaInput::What::Corner) return 0.0;
          const Vec3& p = in.index < reference.corners.size() ? reference.corners[in.index] : free;
          return in.row == 0 ? p.x : in.row == 1 ? p.y : p.z;
        });
      }
      values.run();
      for (int column = first; column < last; ++column) {
        const double value = values.quality(static_cast<std::size_t>(column - first));
        picture.values.push_back(static_cast<float>(value));
        picture.greatest = std::max(picture.greatest, value);
      }
    }
  return picture;
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

FormulaCheck check_formula(const std::string& text) {
  FormulaCheck check{.text = text};
  try {
    const Formula formula(text);
    const FormulaFacts facts = facts_of(formula);
    check.name = "formula:" + formula.text();
    check.kinds = words(formula.kinds());
    check.summary = facts.summary;
    check.warnings = facts.warnings;
    for (const ReferenceElement& reference : references()) {
      if (!contains(formula.kinds(), reference.kind)) continue;
      check.picture = picture_of(formula, reference);
      break;
    }
  } catch (const FormulaError& error) {
    check.place = error.place();
    check.error = error.reason();
  } catch (const Error& error) {
    check.error = error.what();
  }
  return check;
}

}  // namespace dmoscope::ui
