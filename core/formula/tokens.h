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
  std::string text{};  // of a sign its one or two letters; of a text without the quotes
  double number = 0.0;
  [[nodiscard]] bool is(std::string_view sign) const { return kind == TokenKind::Sign && text == sign; }
  /// As messages name it: "'+'", "the name 'area'", "the end".
  [[nodiscard]] std::string words() const;
};

/// The last one is End. Separators (semicolons, new lines) inside round brackets are left out. Throws FormulaError.
[[nodiscard]] std::vector<Token> tokens_of(std::string_view text);

}  // namespace dmoscope
