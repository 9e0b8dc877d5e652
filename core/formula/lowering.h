#pragma once
// From a formula's tree to programs.

#include <string>
#include <vector>

#include "core/formula/element_numbers.h"
#include "core/formula/program.h"
#include "core/formula/syntax.h"

namespace dmoscope {

/// A formula's body makes no sense for a kind of element, or not in a space; what() says why.
class NotForKind : public FormulaError {
 public:
  using FormulaError::FormulaError;
};

struct LoweredFormula {
  FormulaProgram program;
  bool scale_free = true;
  std::string scale_note{};  // why not: "adds a length to a number (column 7)"; empty where it has a unit as a whole
  double power = 0.0;        // of a length, that it has as a whole
  bool uses_place = false;   // it changes when the mesh is moved
};

/// One of the smooth numbers that a formula is the least of.
struct FormulaPiece {
  FormulaProgram program;    // of Elements
  std::uint8_t corners = 0;  // the element's corners that it depends on, a bit each
};

/// `fields`: names of the fields used, in the order of FormulaInput::index; new ones are added. `use`, `moving`: see FormulaProgram; where
/// a formula is the least over the corners of a volume element, only those count that the moving one changes. Throws NotForKind, and
/// FormulaError for what makes no sense at all.
[[nodiscard]] LoweredFormula lower(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind, FormulaSpace space,
                                   FormulaUse use, Index moving, std::vector<std::string>& fields);
/// The formula as the least of pieces, in every element that is not inverted: see ProgramBuilder::pieces_of(). Throws as lower() does.
[[nodiscard]] std::vector<FormulaPiece> lower_pieces(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind,
                                                     FormulaSpace space, std::vector<std::string>& fields);

}  // namespace dmoscope
