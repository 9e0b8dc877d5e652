#include "ui/analysis/formula_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quality/formula_facts.h"
#include "core/quality/formula_values.h"

namespace dmoscope::ui {

namespace {

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
