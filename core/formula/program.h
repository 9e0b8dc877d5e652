#pragma once
// A formula for one kind of element, as code for registers: without branches, with the same steps for every element.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/formula/operation.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// An input of a program.
struct FormulaInput {
  enum class What : std::uint8_t {
    Corner,       // coordinate `row` of corner `index`
    Origin,       // coordinate `row` of the common origin of the corners
    Target,       // corner `index`: row and column of the matrix from the element's edges to the target's, multiplied from the right
    Stretch,      // row and column of the matrix from the element's space to the target's, multiplied from the left
    MeanMeasure,  // mean measure of the mesh's elements
    Steepness,    // for Places in a target's space: factor by which the metric falls faster below 1 than elsewhere
    Field         // number `index`
  };
  What what = What::Corner;
  std::uint8_t index = 0, row = 0, column = 0;
  friend bool operator==(const FormulaInput&, const FormulaInput&) = default;
};

/// Which numbers vary while a program runs for many places, or many elements, at once.
enum class FormulaUse : std::uint8_t {
  Elements,  // all numbers vary: an element a slot
  Places     // the coordinates of one corner vary: a place of it a slot
};

/// A step: registers[to] = operation(a, b, c). Operands below `uniforms` are uniform numbers, the others registers.
struct FormulaStep {
  Operation operation;
  std::uint16_t to, a, b, c;
};

struct FormulaProgram {
  ElementKind kind = ElementKind::Triangle;
  FormulaUse use = FormulaUse::Elements;
  Index moving = kNoIndex;  // the corner that moves; none for Elements, the formula of the whole element
  std::uint16_t uniforms = 0, registers = 0;
  struct Given {
    FormulaInput input;
    std::uint16_t at;  // index of a uniform number or, in `varying`, of a register
  };
  struct Constant {
    double value;
    std::uint16_t at;
  };
  std::vector<Given> given, varying;    // uniform and varying inputs
  std::vector<Constant> constants;      // uniform constants
  std::vector<FormulaStep> beforehand;  // steps on uniform numbers, into uniform numbers
  std::vector<FormulaStep> steps;
  std::optional<std::uint16_t> ceiling;  // for Places: uniform number that is an upper bound of all results
  std::uint16_t result = 0;  // operand of the metric; for Places it is kNeverBest if the moving corner makes an element inverted
};

/// Worth of a place that no vertex may move to.
inline constexpr double kNeverBest = -3e38;

/// Greatest count of numbers in a program.
inline constexpr std::size_t kMostNumbers = 20000;

}  // namespace dmoscope
