// Splitting of a number of a program into smooth numbers whose least it is.

#include <algorithm>

#include "core/formula/program_builder.h"

namespace dmoscope {

namespace {

/// Greatest number of pieces: with more the number stays whole, with its kinks.
constexpr std::size_t kMostPieces = 64;

/// A number's sign in every element that is not inverted; 0 counts as either.
enum class Sign : std::int8_t { Negative = -1, Unknown = 0, Positive = 1 };

Sign sign_of_product(Sign a, Sign b) { return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b)); }
Sign same(Sign a, Sign b) { return a == b ? a : Sign::Unknown; }

}  // namespace

/// Splits a number by going from the result to its operands. `Of`: whether the least or the greatest of the parts is the number.
class ProgramBuilder::Splitter {
 public:
  enum class Of : std::uint8_t { Least, Greatest };
  explicit Splitter(ProgramBuilder& builder) : builder_(builder) {}

  [[nodiscard]] std::vector<Number> split(Number number, Of of) {
    number = chosen(number);
    const Node node = builder_.nodes_[number];  // a copy, since new numbers may move the nodes
    if (node.what != Node::What::Step) return {number};
    const Number a = node.operands[0], b = node.operands[1];
    if (node.operation == (of == Of::Least ? Operation::Minimum : Operation::Maximum)) return joined(number, split(a, of), split(b, of));
    const auto [by_a, by_b] = slopes(node);
    const bool two = operand_count(node.operation) == 2;
    const std::vector<Number> first = split_operand(a, by_a, of);
    const std::vector<Number> second = two ? split_operand(b, by_b, of) : std::vector<Number>{0};
    if (first.size() * second.size() == 1 || first.size() * second.size() > kMostPieces) return {number};
    std::vector<Number> all;
    for (const Number x : first)
      for (const Number y : second) {
        const bool says_nothing = two && x == y && node.operation == Operation::Divide;  // 1 for every element
        if (!says_nothing) keep_once(all, builder_.apply(node.operation, x, y));
      }
    return all;
  }

 private:
  [[nodiscard]] std::vector<Number> split_operand(Number operand, Sign slope, Of of) {
    if (slope == Sign::Unknown) return {operand};
    const Of other = of == Of::Least ? Of::Greatest : Of::Least;
    return split(operand, slope == Sign::Positive ? of : other);
  }
  static void keep_once(std::vector<Number>& all, Number one) {
    if (std::ranges::find(all, one) == all.end()) all.push_back(one);
  }
  [[nodiscard]] static std::vector<Number> joined(Number whole, std::vector<Number> a, const std::vector<Number>& b) {
    for (const Number one : b) keep_once(a, one);
    return a.size() > kMostPieces ? std::vector<Number>{whole} : a;
  }

  /// The operand that a selection by a number of known sign chooses; any other number itself.
  [[nodiscard]] Number chosen(Number number) const {
    const Node& node = builder_.nodes_[number];
    if (node.what != Node::What::Step || node.operation != Operation::Select) return number;
    const Node& condition = builder_.nodes_[node.operands[0]];
    if (condition.what != Node::What::Step || condition.operation != Operation::Less) return number;
    const Number a = condition.operands[0], b = condition.operands[1];
    const auto is_zero = [this](Number n) { return builder_.value_of(n) != nullptr && *builder_.value_of(n) == 0.0; };
    if (is_zero(a) && sign(b) == Sign::Positive) return chosen(node.operands[1]);
    if (is_zero(b) && sign(a) == Sign::Positive) return chosen(node.operands[2]);
    return number;
  }

  /// Whether an operation is increasing or decreasing in each of its first two operands.
  struct Slopes {
    Sign by_a, by_b;
  };
  [[nodiscard]] Slopes slopes(const Node& node) const {
    constexpr Sign kUp = Sign::Positive, kDown = Sign::Negative, kNone = Sign::Unknown;
    const Number a = node.operands[0], b = node.operands[1];
    switch (node.operation) {
      case Operation::Add:
      case Operation::Minimum:
      case Operation::Maximum:
        return {kUp, kUp};
      case Operation::Subtract:
        return {kUp, kDown};
      case Operation::Multiply:
        return {sign(b), sign(a)};
      case Operation::Divide:  // unknown if the divisor changes its sign
        return {sign(b), sign(b) == kNone ? kNone : sign_of_product(kDown, sign(a))};
      case Operation::Absolute:
        return {sign(a), kNone};
      case Operation::SquareRoot:
      case Operation::CubeRoot:
      case Operation::Exponential:
      case Operation::Logarithm:
        return {kUp, kNone};
      case Operation::ArcTangent:
        return {sign(b) == kUp ? kUp : kNone, sign(a) == kUp ? kDown : kNone};
      case Operation::Power: {
        const double* exponent = builder_.value_of(b);
        return {exponent != nullptr && *exponent > 0.0 ? kUp : kNone, kNone};
      }
      default:
        return {kNone, kNone};
    }
  }

  [[nodiscard]] Sign sign(Number number) const {
    number = chosen(number);
    if (std::ranges::find(builder_.positive_, number) != builder_.positive_.end()) return Sign::Positive;
    const Node& node = builder_.nodes_[number];
    if (node.what == Node::What::Constant) return node.value < 0.0 ? Sign::Negative : Sign::Positive;
    if (node.what == Node::What::Input) return node.input.what == FormulaInput::What::MeanMeasure ? Sign::Positive : Sign::Unknown;
    const Number a = node.operands[0], b = node.operands[1];
    switch (node.operation) {
      case Operation::Add:
        return same(sign(a), sign(b));
      case Operation::Subtract:
        return same(sign(a), sign_of_product(Sign::Negative, sign(b)));
      case Operation::Multiply:
      case Operation::Divide:
        return a == b ? Sign::Positive : sign_of_product(sign(a), sign(b));
      case Operation::Minimum:
        return sign(a) == Sign::Negative || sign(b) == Sign::Negative ? Sign::Negative : same(sign(a), sign(b));
      case Operation::Maximum:
        return sign(a) == Sign::Positive || sign(b) == Sign::Positive ? Sign::Positive : same(sign(a), sign(b));
      case Operation::CubeRoot:
      case Operation::ArcTangent:
        return sign(a) == Sign::Negative && node.operation == Operation::ArcTangent ? Sign::Unknown : sign(a);
      case Operation::Select:
        return same(sign(b), sign(node.operands[2]));
      case Operation::Absolute:
      case Operation::SquareRoot:
      case Operation::Exponential:
      case Operation::Power:
      case Operation::Less:
      case Operation::LessOrEqual:
      case Operation::Equal:
        return Sign::Positive;
      default:
        return Sign::Unknown;
    }
  }

  ProgramBuilder& builder_;
};

void ProgramBuilder::mark_positive(Number number) {
  if (std::ranges::find(positive_, number) == positive_.end()) positive_.push_back(number);
}

std::vector<ProgramBuilder::Number> ProgramBuilder::pieces_of(Number number) { return Splitter(*this).split(number, Splitter::Of::Least); }

std::uint8_t ProgramBuilder::corners_of(Number number) const {
  const std::vector<bool> is_needed = needed(number);
  unsigned corners = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (is_needed[i] && nodes_[i].what == Node::What::Input && nodes_[i].input.what == FormulaInput::What::Corner)
      corners |= 1U << nodes_[i].input.index;
  return static_cast<std::uint8_t>(corners);
}

}  // namespace dmoscope
