#pragma once
// The syntax of formulas, and their parsing into a tree.
//
//   formula  := [ "title" ; ] ( body | { kind, kind { body } } )
//   body     := { name = expression ; } expression
//
// Expressions are the usual ones: || && ! comparisons + - * / ^ calls and brackets. A new line ends a statement like a semicolon; # starts
// a comment. Semicolons and new lines inside round brackets count as blanks.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/mesh/kind_set.h"

namespace dmoscope {

// Errors in formulas, with their place.

/// A place in a formula's text, from 1; columns count letters, not bytes.
struct FormulaPlace {
  std::size_t line = 1, column = 1;
  friend bool operator==(const FormulaPlace&, const FormulaPlace&) = default;
};

/// A formula that cannot be parsed or makes no sense. what() is "formula, column 7: reason", with "line 2, " if there are several lines.
class FormulaError : public UsageError {
 public:
  FormulaError(FormulaPlace place, const std::string& what);
  [[nodiscard]] FormulaPlace place() const noexcept { return place_; }
  /// The message without the place.
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

 private:
  FormulaPlace place_;
  std::string reason_;
};

// The words and signs of a formula.

enum class TokenKind : std::uint8_t { Number, Name, Text, Sign, Separator, End };

struct Token {
  TokenKind kind = TokenKind::End;
  FormulaPlace place{};
  std::string text{};  // a sign's one or two letters; a text without the quotes
  double number = 0.0;
  [[nodiscard]] bool is(std::string_view sign) const { return kind == TokenKind::Sign && text == sign; }
  /// The token as messages name it: "'+'", "the name 'area'", "the end".
  [[nodiscard]] std::string words() const;
};

/// Splits a formula into tokens, the last of which is End. Separators (semicolons, new lines) inside round brackets are left out. Throws
/// FormulaError.
[[nodiscard]] std::vector<Token> tokens_of(std::string_view text);

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
