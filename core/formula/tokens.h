#pragma once
// The words and signs of a formula.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/formula_error.h"

namespace dmoscope {

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

}  // namespace dmoscope
