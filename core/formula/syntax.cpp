#include "core/formula/syntax.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "core/base/unknown_value.h"

namespace dmoscope {

namespace {
std::string sentence(FormulaPlace place, const std::string& what) {
  const std::string line = place.line > 1 ? fmt::format("line {}, ", place.line) : std::string();
  return fmt::format("formula, {}column {}: {}", line, place.column, what);
}
}  // namespace

FormulaError::FormulaError(FormulaPlace place, const std::string& what) : UsageError(sentence(place, what)), place_(place), reason_(what) {}

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

namespace {

/// Binary signs, weakest binding first.
struct BinarySign {
  std::string_view sign;
  Syntax what;
  int rank;
};
constexpr std::array kBinary{
    BinarySign{"||", Syntax::Or, 0},          BinarySign{"&&", Syntax::And, 1},      BinarySign{"<", Syntax::Less, 2},
    BinarySign{"<=", Syntax::LessOrEqual, 2}, BinarySign{">", Syntax::Greater, 2},   BinarySign{">=", Syntax::GreaterOrEqual, 2},
    BinarySign{"==", Syntax::Equal, 2},       BinarySign{"!=", Syntax::NotEqual, 2}, BinarySign{"+", Syntax::Add, 3},
    BinarySign{"-", Syntax::Subtract, 3},     BinarySign{"*", Syntax::Multiply, 4},  BinarySign{"/", Syntax::Divide, 4}};
constexpr int kComparison = 2, kHighest = 4;

class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(tokens_of(text)) {}

  FormulaSyntax run() {
    skip_separators();
    if (here().kind == TokenKind::Text) {
      syntax_.title = here().text;
      advance();
      if (here().kind != TokenKind::Separator) fail("';' after the title");
      skip_separators();
    }
    if (starts_section()) {
      while (here().kind != TokenKind::End) section();
    } else {
      syntax_.bodies.push_back(body());
      if (here().is(")")) throw FormulaError(here().place, "this ')' closes nothing");
      if (here().kind != TokenKind::End) fail("a sign between the two, ';', or the end");
    }
    return std::move(syntax_);
  }

 private:
  [[nodiscard]] const Token& here() const { return tokens_[at_]; }
  [[nodiscard]] const Token& after() const { return tokens_[std::min(at_ + 1, tokens_.size() - 1)]; }
  void advance() {
    if (at_ + 1 < tokens_.size()) ++at_;
  }
  void skip_separators() {
    while (here().kind == TokenKind::Separator) advance();
  }
  [[noreturn]] void fail(std::string_view expected) const {
    throw FormulaError(here().place, fmt::format("expected {}, not {}", expected, here().words()));
  }
  void expect(std::string_view sign) {
    if (!here().is(sign)) fail(fmt::format("'{}'", sign));
    advance();
  }

  /// Whether a section starts here: "triangle {", "triangle, quadrilateral {".
  [[nodiscard]] bool starts_section() const {
    return here().kind == TokenKind::Name && (after().is("{") || (after().is(",") && kind_named(here().text)));
  }
  [[nodiscard]] static std::optional<ElementKind> kind_named(std::string_view word) {
    for (std::size_t k = 0; k < kElementKindCount; ++k)
      if (word == kElementKinds[k].name || word == kElementKinds[k].plural) return static_cast<ElementKind>(k);
    return std::nullopt;
  }

  void section() {
    KindSet kinds = 0;
    const FormulaPlace place = here().place;
    for (;;) {
      if (here().kind != TokenKind::Name) fail("the name of a kind of elements");
      const auto kind = kind_named(here().text);
      if (!kind) throw FormulaError(here().place, unknown_row("kind of elements", here().text, kElementKinds));
      KindSet taken = kinds;
      for (const FormulaBody& other : syntax_.bodies) taken = static_cast<KindSet>(taken | other.kinds);
      if (contains(taken, *kind)) throw FormulaError(here().place, fmt::format("the {} have a formula already", info(*kind).plural));
      kinds = static_cast<KindSet>(kinds | kind_set(*kind));
      advance();
      if (!here().is(",")) break;
      advance();
    }
    expect("{");
    FormulaBody body = this->body();
    body.kinds = kinds;
    body.place = place;
    expect("}");
    skip_separators();
    syntax_.bodies.push_back(std::move(body));
  }

  FormulaBody body() {
    FormulaBody body;
    parts_.clear();
    skip_separators();
    body.place = here().place;
    while (here().kind == TokenKind::Name && after().is("=")) {
      const Token name = here();
      for (const FormulaBody::Part& other : body.parts)
        if (other.name == name.text) throw FormulaError(name.place, fmt::format("'{}' has a value already", name.text));
      advance();
      advance();
      const SyntaxId value = expression(0);
      if (here().kind != TokenKind::Separator)
        fail(here().kind == TokenKind::End || here().is("}") ? "';' and what the metric is: this only names a part" : "a sign or ';'");
      skip_separators();
      body.parts.push_back({name.text, value});
      parts_[name.text] = heights_[value];
    }
    body.result = expression(0);
    skip_separators();
    return body;
  }

  SyntaxId add(Syntax what, FormulaPlace place, std::vector<SyntaxId> operands) {
    std::size_t height = 0;
    for (const SyntaxId operand : operands) height = std::max(height, heights_[operand]);
    syntax_.nodes.push_back({what, place, 0.0, {}, std::move(operands)});
    heights_.push_back(0);
    set_height(static_cast<SyntaxId>(syntax_.nodes.size() - 1), height + 1);
    return static_cast<SyntaxId>(syntax_.nodes.size() - 1);
  }
  void set_height(SyntaxId id, std::size_t height) {
    if (height > kMostFormulaHeight)
      throw FormulaError(syntax_.nodes[id].place, fmt::format("more than {} steps in a row: shorten this", kMostFormulaHeight));
    heights_[id] = std::max(heights_[id], height);
  }

  /// Counts the nesting depth of brackets and signs.
  class Deeper {
   public:
    explicit Deeper(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kMostFormulaDepth)
        throw FormulaError(parser_.here().place, fmt::format("more than {} brackets and signs inside each other", kMostFormulaDepth));
    }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    ~Deeper() { --parser_.depth_; }

   private:
    Parser& parser_;
  };

  /// Parses an expression of signs that bind at least as strongly as `rank`.
  SyntaxId expression(int rank) {
    if (rank > kHighest) return unary();
    SyntaxId left = expression(rank + 1);
    for (bool compared = false;; compared = true) {
      const auto sign = std::ranges::find_if(kBinary, [&](const BinarySign& s) { return s.rank == rank && here().is(s.sign); });
      if (sign == kBinary.end()) return left;
      if (rank == kComparison && compared) throw FormulaError(here().place, "comparisons come one at a time: join two with '&&'");
      const FormulaPlace place = here().place;
      advance();
      left = add(sign->what, place, {left, expression(rank + 1)});
    }
  }

  SyntaxId unary() {
    const Deeper deeper(*this);
    const FormulaPlace place = here().place;
    if (here().is("-")) return advance(), add(Syntax::Negate, place, {unary()});
    if (here().is("+")) return advance(), unary();
    if (here().is("!")) return advance(), add(Syntax::Not, place, {unary()});
    const SyntaxId base = primary();
    if (!here().is("^")) return base;
    const FormulaPlace sign = here().place;
    advance();
    return add(Syntax::Power, sign, {base, unary()});
  }

  SyntaxId primary() {
    const Token token = here();
    if (token.is("(")) {
      advance();
      const SyntaxId inside = expression(0);
      if (!here().is(")")) fail("a sign or ')'");
      advance();
      return inside;
    }
    if (token.kind != TokenKind::Number && token.kind != TokenKind::Name && token.kind != TokenKind::Text) fail("a number, a name or '('");
    advance();
    const SyntaxId id = add(token.kind == TokenKind::Number ? Syntax::Number
                            : token.kind == TokenKind::Text ? Syntax::Text
                                                            : Syntax::Name,
                            token.place, {});
    syntax_.nodes[id].number = token.number;
    syntax_.nodes[id].text = token.text;
    if (token.kind == TokenKind::Name && here().is("("))
      call(id);
    else if (const auto part = parts_.find(token.text); token.kind == TokenKind::Name && part != parts_.end())
      set_height(id, part->second + 1);
    return id;
  }

  void call(SyntaxId id) {
    advance();
    std::vector<SyntaxId> arguments;
    if (!here().is(")")) {
      arguments.push_back(expression(0));
      while (here().is(",")) {
        advance();
        arguments.push_back(expression(0));
      }
    }
    if (!here().is(")")) fail("a sign, ',' or ')'");
    advance();
    syntax_.nodes[id].what = Syntax::Call;
    for (const SyntaxId argument : arguments) set_height(id, heights_[argument] + 1);
    syntax_.nodes[id].operands = std::move(arguments);
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0, depth_ = 0;
  FormulaSyntax syntax_;
  std::vector<std::size_t> heights_;                    // heights of the nodes
  std::unordered_map<std::string, std::size_t> parts_;  // heights of the parts of the current body
};

}  // namespace

FormulaSyntax parse_formula(std::string_view text) {
  if (text.size() > kMostFormulaText)
    throw FormulaError({1, 1}, fmt::format("a formula has at most {} letters, and this has {}", kMostFormulaText, text.size()));
  return Parser(text).run();
}

}  // namespace dmoscope
