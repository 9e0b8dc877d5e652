#include "core/formula/tokens.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace dmoscope {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
/// Whether a byte continues a UTF-8 letter of several bytes.
bool continues_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::vector<Token> run() {
    while (at_ < text_.size()) scan();
    add(TokenKind::End, {});
    return std::move(tokens_);
  }

 private:
  void scan() {
    const char c = text_[at_];
    if (c == ' ' || c == '\t' || c == '\r') return skip(1);
    if (c == '#') return skip(std::min(text_.find('\n', at_), text_.size()) - at_);
    if (c == '\n' || c == ';') return separator(c);
    if (is_digit(c) || (c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) return number();
    if (is_letter(c)) return name();
    if (c == '"') return quoted();
    sign();
  }

  void separator(char c) {
    if (open_ == 0) add(TokenKind::Separator, std::string(1, c));
    skip(1);
    if (c == '\n') place_ = {place_.line + 1, 1};
  }

  void number() {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    const std::size_t size = static_cast<std::size_t>(end - (text_.data() + at_));
    if (error != std::errc{} || !std::isfinite(value)) throw FormulaError(place_, "this number is too large or too small");
    if (at_ + size < text_.size() && is_letter(text_[at_ + size]))
      throw FormulaError({place_.line, place_.column + size}, fmt::format("a sign is missing between the number {} and the letter '{}'",
                                                                          text_.substr(at_, size), text_[at_ + size]));
    add(TokenKind::Number, std::string(text_.substr(at_, size)));
    tokens_.back().number = value;
    skip(size);
  }

  void name() {
    std::size_t size = 1;
    while (at_ + size < text_.size() && (is_letter(text_[at_ + size]) || is_digit(text_[at_ + size]))) ++size;
    add(TokenKind::Name, std::string(text_.substr(at_, size)));
    skip(size);
  }

  void quoted() {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == std::string_view::npos || text_.substr(at_, end - at_).find('\n') != std::string_view::npos)
      throw FormulaError(place_, "the quotation mark that ends this text is missing");
    add(TokenKind::Text, std::string(text_.substr(at_ + 1, end - at_ - 1)));
    skip(end + 1 - at_);
  }

  void sign() {
    constexpr std::array<std::string_view, 6> kPairs{"<=", ">=", "==", "!=", "&&", "||"};
    const std::string_view two = text_.substr(at_, 2);
    if (std::ranges::find(kPairs, two) != kPairs.end()) {
      add(TokenKind::Sign, std::string(two));
      return skip(2);
    }
    const char c = text_[at_];
    if (std::string_view("+-*/^()<>,=!{}").find(c) == std::string_view::npos) throw FormulaError(place_, unknown_sign());
    if (c == '(') ++open_;
    if (c == ')' && open_ > 0) --open_;
    add(TokenKind::Sign, std::string(1, c));
    skip(1);
  }

  [[nodiscard]] std::string unknown_sign() const {
    const char c = text_[at_];
    if (c == '&' || c == '|') return fmt::format("'{0}' alone means nothing: write '{0}{0}'", c);
    if (c == '[' || c == ']') return fmt::format("'{}' means nothing here: brackets are round", c);
    std::size_t size = 1;
    while (at_ + size < text_.size() && continues_letter(text_[at_ + size])) ++size;
    if (static_cast<unsigned char>(c) < 0x20U) return fmt::format("a letter with the code {} means nothing here", static_cast<int>(c));
    return fmt::format("'{}' means nothing here", text_.substr(at_, size));
  }

  void add(TokenKind kind, std::string text) { tokens_.push_back({kind, place_, std::move(text)}); }
  void skip(std::size_t bytes) {
    for (const char c : text_.substr(at_, bytes)) place_.column += continues_letter(c) ? 0U : 1U;
    at_ += bytes;
  }

  std::string_view text_;
  std::size_t at_ = 0, open_ = 0;
  FormulaPlace place_{};
  std::vector<Token> tokens_;
};

}  // namespace

std::string Token::words() const {
  switch (kind) {
    case TokenKind::Number:
      return fmt::format("the number {}", text);
    case TokenKind::Name:
      return fmt::format("the name '{}'", text);
    case TokenKind::Text:
      return fmt::format("the text \"{}\"", text);
    case TokenKind::Sign:
      return fmt::format("'{}'", text);
    case TokenKind::Separator:
      return text == ";" ? "';'" : "the end of the line";
    case TokenKind::End:
      break;
  }
  return "the end";
}

std::vector<Token> tokens_of(std::string_view text) { return Scanner(text).run(); }

}  // namespace dmoscope
