#pragma once
// Metrics that a person may choose besides the built-in ones: those that have names, and a formula while it is typed.

#include <optional>
#include <string>
#include <vector>

#include "core/formula/syntax.h"
#include "core/quality/metric.h"
#include "core/view/view.h"

namespace dmoscope::ui {

/// Formulas with names of their own, those of the session's runs and the one that is shown; if the active run has a target, metrics against
/// it. All are defined for the active mesh.
[[nodiscard]] std::vector<Metric> further_metrics(const SessionView& session);

/// A target that fits a mesh, as it is written, with its name in lists.
struct TargetChoice {
  std::string text, title, doc;
};
[[nodiscard]] std::vector<TargetChoice> target_choices(const InputMesh& input);

/// The metric as a function of the last corner of a reference element, whose other corners are fixed: at the middles of columns x rows
/// equal cells.
struct FormulaPicture {
  ElementKind kind = ElementKind::Triangle;
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;  // bounds of the picture; of a tetrahedron: x, and z above the middle of its base
  int columns = 0, rows = 0;
  std::vector<float> values{};                       // row by row from below
  std::vector<std::pair<double, double>> corners{};  // the fixed corners
  double greatest = 0.0;
};

struct FormulaCheck {
  std::string text{};                      // text of the formula
  std::optional<FormulaPlace> place{};     // place of the error
  std::string error{};                     // message of the error; empty: none
  std::string name{}, kinds{}, summary{};  // for a correct formula: name of its metric, "triangles and ...", its facts
  std::vector<std::string> warnings{};
  std::optional<FormulaPicture> picture{};  // for triangles, quadrilaterals or tetrahedra, the first of these that the formula allows
};

/// Examines a formula. Never throws.
[[nodiscard]] FormulaCheck check_formula(const std::string& text);

}  // namespace dmoscope::ui
