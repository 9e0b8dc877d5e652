#pragma once
// The syntax of formulas: text to a tree.
//
//   formula  := [ "title" ; ] ( body | { kind, kind { body } } )
//   body     := { name = expression ; } expression
//
// Expressions are the usual ones: || && ! comparisons + - * / ^ calls and brackets. A new line ends what a semicolon ends; # starts a
// comment. Semicolons and new lines inside round brackets count as blanks.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/formula_error.h"
#include "core/mesh/kind_set.h"

namespace dmoscope {

enum class Syntax : std::uint8_t {
  Number,
  Text,  // in double quotes: a field's name
  Name,
  Call,  // of `text`
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

using SyntaxId = std::uint32_t;  // of a node, into FormulaSyntax::nodes

struct SyntaxNode {
  Syntax what = Syntax::Number;
  FormulaPlace place{};
  double number = 0.0;
  std::string text{};                // of a name, call or text
  std::vector<SyntaxId> operands{};  // of a call its arguments
};

/// The formula of some kinds of elements.
struct FormulaBody {
  struct Part {
    std::string name;
    SyntaxId value;
  };
  KindSet kinds = 0;  // 0: all that it makes sense for
  FormulaPlace place{};
  std::vector<Part> parts{};  // each may use those before it
  SyntaxId result = 0;
};

struct FormulaSyntax {
  std::string title{};
  std::vector<SyntaxNode> nodes{};
  std::vector<FormulaBody> bodies{};
};

/// At most this many letters, brackets inside each other, and steps from a result to what it is made of: more than any person writes.
inline constexpr std::size_t kMostFormulaText = 20000, kMostFormulaDepth = 100, kMostFormulaHeight = 300;

/// Throws FormulaError that says what was expected.
[[nodiscard]] FormulaSyntax parse_formula(std::string_view text);

}  // namespace dmoscope
