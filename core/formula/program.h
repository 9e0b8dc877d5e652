#pragma once
// A formula for one kind of element, as code for registers: no branch, the same steps whatever the element looks like.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/formula/operation.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// A number that a program is given.
struct FormulaInput {
  enum class What : std::uint8_t {
    Corner,       // coordinate `row` of corner `index`
    Origin,       // coordinate `row` of what corners are relative to
    Target,       // of corner `index`: row and column of what makes the target's edges of the element's, from the right
    Stretch,      // row and column of what makes the target's space of the element's, from the left
    MeanMeasure,  // of the mesh's elements
    Steepness,    // of Places, in a target's space: how much faster than elsewhere the metric falls below 1
    Field         // number `index`
  };
  What what = What::Corner;
  std::uint8_t index = 0, row = 0, column = 0;
  friend bool operator==(const FormulaInput&, const FormulaInput&) = default;
};

/// Which numbers vary while a program runs for many places, or many elements, at once.
enum class FormulaUse : std::uint8_t {
  Elements,  // all: an element a slot
  Places     // the coordinates of one corner: a place of it a slot
};

/// A step: registers[to] = operation(a, b, c). Operands below `uniforms` are uniform numbers, those from there on registers.
struct FormulaStep {
  Operation operation;
  std::uint16_t to, a, b, c;
};

struct FormulaProgram {
  ElementKind kind = ElementKind::Triangle;
  FormulaUse use = FormulaUse::Elements;
  Index moving = kNoIndex;  // the corner that moves; of Elements none: the formula of the whole element
  std::uint16_t uniforms = 0, registers = 0;
  struct Given {
    FormulaInput input;
    std::uint16_t at;  // a uniform number or, of `varying`, a register
  };
  struct Constant {
    double value;
    std::uint16_t at;
  };
  std::vector<Given> given, varying;    // what is uniform, what is not
  std::vector<Constant> constants;      // uniform
  std::vector<FormulaStep> beforehand;  // with uniform numbers alone: `to` is one, too
  std::vector<FormulaStep> steps;
  std::optional<std::uint16_t> ceiling;  // of Places: a uniform number that no place's result is above
  std::uint16_t result = 0;  // as an operand: the metric; of Places kNeverBest where the moving corner makes an element inverted
};

/// What a place is worth that no vertex may go to.
inline constexpr double kNeverBest = -3e38;

/// A program has at most so many numbers.
inline constexpr std::size_t kMostNumbers = 20000;

}  // namespace dmoscope
