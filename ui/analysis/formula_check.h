#pragma once
// What there is to say of a formula while it is typed, and a picture of it.

#include <optional>
#include <string>
#include <vector>

#include "core/formula/formula_error.h"
#include "core/quality/metric.h"

namespace dmoscope::ui {

/// The metric over the last corner of a reference element, whose others stand still: at the middles of columns x rows equal cells.
struct FormulaPicture {
  ElementKind kind = ElementKind::Triangle;
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;  // of a tetrahedron: x, and z above the middle of its base
  int columns = 0, rows = 0;
  std::vector<float> values{};                       // row by row from below
  std::vector<std::pair<double, double>> corners{};  // those that stand still
  double greatest = 0.0;
};

struct FormulaCheck {
  std::string text{};                      // what it is about
  std::optional<FormulaPlace> place{};     // where it is wrong
  std::string error{};                     // and what is; empty: nothing
  std::string name{}, kinds{}, summary{};  // of one that is right: of its metric, "triangles and ...", its facts
  std::vector<std::string> warnings{};
  std::optional<FormulaPicture> picture{};  // of triangles, quadrilaterals or tetrahedra, the first that it is for
};

/// Never throws.
[[nodiscard]] FormulaCheck check_formula(const std::string& text);

}  // namespace dmoscope::ui
