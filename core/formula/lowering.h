#pragma once
// Translation of a formula's tree into programs.

#include <string>
#include <vector>

#include "core/formula/element_numbers.h"
#include "core/formula/program.h"
#include "core/formula/syntax.h"

namespace dmoscope {

/// Thrown if a formula's body makes no sense for a kind of element, or not in a space; what() tells why.
class NotForKind : public FormulaError {
 public:
  using FormulaError::FormulaError;
};

struct LoweredFormula {
  FormulaProgram program;
  bool scale_free = true;
  std::string scale_note{};  // reason why it is not scale-free: "adds a length to a number (column 7)"; empty if it has a unit as a whole
  double power = 0.0;        // power of a length that it has as a whole
  bool uses_place = false;   // whether it changes when the mesh is moved
};

/// One of the smooth numbers whose least is the formula.
struct FormulaPiece {
  FormulaProgram program;    // program of FormulaUse::Elements
  std::uint8_t corners = 0;  // bits of the element's corners that it depends on
};

/// Translates a formula's body. `fields`: names of the fields used, in the order of FormulaInput::index; new ones are added. `use`,
/// `moving`: see FormulaProgram; if a formula is the least over the corners of a volume element, only corners count that the moving one
/// changes. Throws NotForKind, and FormulaError if the formula makes no sense for any kind.
[[nodiscard]] LoweredFormula lower(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind, FormulaSpace space,
                                   FormulaUse use, Index moving, std::vector<std::string>& fields);
/// Translates a formula into pieces whose least it is in every element that is not inverted: see ProgramBuilder::pieces_of(). Throws as
/// lower() does.
[[nodiscard]] std::vector<FormulaPiece> lower_pieces(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind,
                                                     FormulaSpace space, std::vector<std::string>& fields);

}  // namespace dmoscope
