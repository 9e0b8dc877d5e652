#pragma once
// The syntax of formulas, and their parsing into a tree.
//
//   formula  := [ "title" ; ] ( body | { kind, kind { body } } )
//   body     := { name = expression ; } expression
//
// Expressions are the usual ones: || && ! comparisons + - * / ^ calls and brackets. A new line ends a statement like a semicolon; # starts
// a comment. Semicolons and new lines inside round brackets count as blanks.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/formula_error.h"
#include "core/mesh/kind_set.h"

namespace dmoscope {

enum class Syntax : std::uint8_t {
  Number,
  Text,  // a field's name, in double quotes
  Name,
  Call,  // call of function `text`
  Negate,
  Not,
  Add,
  Subtract,
  Multiply,
  Divide,
  Power,
  Less,
  LessOrEqual,
  Greater,
  GreaterOrEqual,
  Equal,
  NotEqual,
  And,
  Or
};

using SyntaxId = std::uint32_t;  // index into FormulaSyntax::nodes

struct SyntaxNode {
  Syntax what = Syntax::Number;
  FormulaPlace place{};
  double number = 0.0;
  std::string text{};                // name, function or text
  std::vector<SyntaxId> operands{};  // operands, or arguments of a call
};

/// The formula for some kinds of elements.
struct FormulaBody {
  struct Part {
    std::string name;
    SyntaxId value;
  };
  KindSet kinds = 0;  // 0: all kinds that it fits
  FormulaPlace place{};
  std::vector<Part> parts{};  // named parts, each of which may use those before it
  SyntaxId result = 0;
};

struct FormulaSyntax {
  std::string title{};
  std::vector<SyntaxNode> nodes{};
  std::vector<FormulaBody> bodies{};
};

/// Limits, beyond all that people write: letters, nested brackets, and steps from a result down to its operands.
inline constexpr std::size_t kMostFormulaText = 20000, kMostFormulaDepth = 100, kMostFormulaHeight = 300;

/// Parses a formula. Throws FormulaError that says what was expected.
[[nodiscard]] FormulaSyntax parse_formula(std::string_view text);

}  // namespace dmoscope
