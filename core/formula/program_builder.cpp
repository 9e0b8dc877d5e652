#include "core/formula/program_builder.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/base/error.h"
#include "core/formula/operations.h"

namespace dmoscope {

namespace {

using Number = ProgramBuilder::Number;

bool is_symmetric(Operation operation) {
  return operation == Operation::Add || operation == Operation::Multiply || operation == Operation::Equal;
}

double folded(Operation operation, double a, double b, double c) {
  if (operation == Operation::Select) return a == 0.0 ? c : b;
  return operations::apply_alone(operation, a, b);
}

}  // namespace

Number ProgramBuilder::keep(const Node& node) {
  std::uint64_t key = static_cast<std::uint64_t>(node.what) * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(node.operation);
  const auto mix = [&key](std::uint64_t value) { key = (key ^ value) * 0xff51afd7ed558ccdULL + (key >> 29U); };
  for (const Number operand : node.operands) mix(operand);
  mix(std::bit_cast<std::uint64_t>(node.value));
  mix(static_cast<std::uint64_t>(node.input.what) << 24U | static_cast<std::uint64_t>(node.input.index) << 16U |
      static_cast<std::uint64_t>(node.input.row) << 8U | node.input.column);
  const auto [first, last] = known_.equal_range(key);
  for (auto at = first; at != last; ++at) {
    const Node& other = nodes_[at->second];
    if (other.what == node.what && other.operation == node.operation && other.operands == node.operands && other.input == node.input &&
        std::bit_cast<std::uint64_t>(other.value) == std::bit_cast<std::uint64_t>(node.value))
      return at->second;
  }
  if (nodes_.size() >= kMostNumbers) throw UsageError("the formula is too large: shorten it, or name parts of it");
  const auto number = static_cast<Number>(nodes_.size());
  nodes_.push_back(node);
  known_.emplace(key, number);
  return number;
}

Number ProgramBuilder::constant(double value) { return keep({Node::What::Constant, Operation::Add, {}, value, {}}); }

Number ProgramBuilder::input(FormulaInput input) { return keep({Node::What::Input, Operation::Add, {}, 0.0, input}); }

const double* ProgramBuilder::value_of(Number number) const {
  return nodes_[number].what == Node::What::Constant ? &nodes_[number].value : nullptr;
}

std::vector<bool> ProgramBuilder::changing(Index corner) const {
  std::vector<bool> changing(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.what == Node::What::Input) changing[i] = node.input.what == FormulaInput::What::Corner && node.input.index == corner;
    if (node.what != Node::What::Step) continue;
    for (int k = 0; k < operand_count(node.operation); ++k)
      changing[i] = changing[i] || changing[node.operands[static_cast<std::size_t>(k)]];
  }
  return changing;
}

bool ProgramBuilder::depends_on(Number number, Index corner) const { return changing(corner)[number]; }

std::optional<Number> ProgramBuilder::ceiling_of(Number number, Index corner) {
  const std::vector<bool> changes = changing(corner);
  std::vector<bool> seen(nodes_.size());
  std::vector<Number> open{number};
  std::optional<Number> ceiling;
  while (!open.empty()) {
    const Number at = open.back();
    open.pop_back();
    if (seen[at]) continue;
    seen[at] = true;
    if (!changes[at])
      ceiling = ceiling ? minimum(*ceiling, at) : at;
    else if (nodes_[at].what == Node::What::Step && nodes_[at].operation == Operation::Minimum)
      open.insert(open.end(), {nodes_[at].operands[0], nodes_[at].operands[1]});
  }
  return ceiling;
}

Number ProgramBuilder::apply(Operation operation, Number a, Number b, Number c) {
  const int count = operand_count(operation);
  if (count < 2) b = 0;
  if (count < 3) c = 0;
  if (is_symmetric(operation) && b < a) std::swap(a, b);
  const double *x = value_of(a), *y = value_of(b), *z = value_of(c);
  if (x != nullptr && (count < 2 || y != nullptr) && (count < 3 || z != nullptr))
    return constant(folded(operation, *x, count < 2 ? 0.0 : *y, count < 3 ? 0.0 : *z));
  if ((operation == Operation::Minimum || operation == Operation::Maximum) && a == b) return a;
  if (operation == Operation::Select && x != nullptr) return *x == 0.0 ? c : b;
  if (operation == Operation::Multiply && x != nullptr && *x == 1.0) return b;
  if (operation == Operation::Multiply && y != nullptr && *y == 1.0) return a;
  return keep({Node::What::Step, operation, {a, b, c}, 0.0, {}});
}

std::vector<bool> ProgramBuilder::needed(Number result) const {
  std::vector<bool> needed(nodes_.size());
  needed[result] = true;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    if (!needed[i] || nodes_[i].what != Node::What::Step) continue;
    for (int k = 0; k < operand_count(nodes_[i].operation); ++k) needed[nodes_[i].operands[static_cast<std::size_t>(k)]] = true;
  }
  return needed;
}

namespace {

/// Assigns registers; those that are not read any more are used again.
class Registers {
 public:
  std::uint16_t take() {
    if (free_.empty()) return count_++;
    const std::uint16_t one = free_.back();
    free_.pop_back();
    return one;
  }
  void give_back(std::uint16_t one) { free_.push_back(one); }
  [[nodiscard]] std::uint16_t count() const { return count_; }

 private:
  std::vector<std::uint16_t> free_;
  std::uint16_t count_ = 0;
};

}  // namespace

FormulaProgram ProgramBuilder::finish(ElementKind kind, FormulaUse use, Index moving, Number result, std::optional<Number> ceiling) const {
  std::vector<bool> is_needed = needed(result);
  if (ceiling) {
    const std::vector<bool> besides = needed(*ceiling);
    for (std::size_t i = 0; i < nodes_.size(); ++i) is_needed[i] = is_needed[i] || besides[i];
  }
  const auto varies_as_input = [&](const FormulaInput& in) {
    if (use == FormulaUse::Elements) return in.what != FormulaInput::What::MeanMeasure;
    return in.what == FormulaInput::What::Corner && in.index == moving;
  };
  std::vector<bool> varies(nodes_.size());
  std::vector<std::size_t> last_use(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (!is_needed[i]) continue;
    if (node.what == Node::What::Input) varies[i] = varies_as_input(node.input);
    if (node.what != Node::What::Step) continue;
    for (int k = 0; k < operand_count(node.operation); ++k) {
      const Number operand = node.operands[static_cast<std::size_t>(k)];
      varies[i] = varies[i] || varies[operand];
      last_use[operand] = i;
    }
  }
  last_use[result] = nodes_.size();

  FormulaProgram program;
  program.kind = kind;
  program.use = use;
  program.moving = moving;
  std::vector<std::uint16_t> place(nodes_.size());  // index of each uniform number, register of each other one
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (is_needed[i] && !varies[i]) place[i] = program.uniforms++;
  Registers registers;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {  // inputs first, so that they keep the registers that they are given in
    if (!is_needed[i] || nodes_[i].what != Node::What::Input) continue;
    if (varies[i]) place[i] = registers.take();
    (varies[i] ? program.varying : program.given).push_back({nodes_[i].input, place[i]});
  }
  const auto operand = [&](Number number) {
    return static_cast<std::uint16_t>(varies[number] ? program.uniforms + place[number] : place[number]);
  };
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (!is_needed[i]) continue;
    if (node.what == Node::What::Constant) program.constants.push_back({node.value, place[i]});
    if (node.what != Node::What::Step) continue;
    const int count = operand_count(node.operation);
    std::array<std::uint16_t, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = operand(node.operands[static_cast<int>(k) < count ? k : 0]);
    if (varies[i]) {
      for (std::size_t k = 0; static_cast<int>(k) < count; ++k) {
        const Number used = node.operands[k];
        const bool again = k > 0 && (node.operands[0] == used || (k > 1 && node.operands[1] == used));
        if (varies[used] && last_use[used] == i && !again) registers.give_back(place[used]);
      }
      place[i] = registers.take();
    }
    (varies[i] ? program.steps : program.beforehand).push_back({node.operation, place[i], at[0], at[1], at[2]});
  }
  program.registers = registers.count();
  program.result = operand(result);
  if (ceiling) program.ceiling = operand(*ceiling);
  return program;
}

// Splitting of a number of a program into smooth numbers whose least it is.

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
