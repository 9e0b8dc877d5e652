#pragma once
// Assembly of a program: equal numbers are computed once, constants are folded, and numbers that no result needs are left out.

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/formula/program.h"

namespace dmoscope {

class ProgramBuilder {
 public:
  using Number = std::uint32_t;  // a number that the program computes

  [[nodiscard]] Number constant(double value);
  [[nodiscard]] Number input(FormulaInput input);
  [[nodiscard]] Number apply(Operation operation, Number a, Number b = 0, Number c = 0);
  [[nodiscard]] const double* value_of(Number number) const;  // value of a constant; null: it is none
  /// Whether the number changes with the element's corner.
  [[nodiscard]] bool depends_on(Number number, Index corner) const;
  /// Upper bound of a minimum: the least of its parts that do not change with the corner. None if all parts change.
  [[nodiscard]] std::optional<Number> ceiling_of(Number number, Index corner);

  // --- Operations that formulas and their vocabulary use ---
  [[nodiscard]] Number add(Number a, Number b) { return apply(Operation::Add, a, b); }
  [[nodiscard]] Number subtract(Number a, Number b) { return apply(Operation::Subtract, a, b); }
  [[nodiscard]] Number multiply(Number a, Number b) { return apply(Operation::Multiply, a, b); }
  [[nodiscard]] Number times(double factor, Number a) { return multiply(constant(factor), a); }
  [[nodiscard]] Number divide(Number a, Number b) { return apply(Operation::Divide, a, b); }
  [[nodiscard]] Number minimum(Number a, Number b) { return apply(Operation::Minimum, a, b); }
  [[nodiscard]] Number maximum(Number a, Number b) { return apply(Operation::Maximum, a, b); }
  [[nodiscard]] Number absolute(Number a) { return apply(Operation::Absolute, a); }
  [[nodiscard]] Number root(Number a) { return apply(Operation::SquareRoot, a); }
  [[nodiscard]] Number arc_tangent(Number y, Number x) { return apply(Operation::ArcTangent, y, x); }
  [[nodiscard]] Number select(Number condition, Number yes, Number no) { return apply(Operation::Select, condition, yes, no); }
  [[nodiscard]] Number less(Number a, Number b) { return apply(Operation::Less, a, b); }

  /// Declares that the number is above 0 in every element that is not inverted.
  void mark_positive(Number number);
  /// Numbers, as smooth as possible, whose least is this one in every element that is not inverted: the parts of a minimum, also below an
  /// increasing function, or those of a maximum below a decreasing one. Each once; the number alone if it has no such parts.
  [[nodiscard]] std::vector<Number> pieces_of(Number number);
  /// Bits of the element's corners that the number depends on.
  [[nodiscard]] std::uint8_t corners_of(Number number) const;

  /// The program with this result; see FormulaProgram.
  [[nodiscard]] FormulaProgram finish(ElementKind kind, FormulaUse use, Index moving, Number result,
                                      std::optional<Number> ceiling = {}) const;

  [[nodiscard]] std::size_t size() const noexcept { return nodes_.size(); }

 private:
  struct Node {
    enum class What : std::uint8_t { Constant, Input, Step } what;
    Operation operation;
    std::array<Number, 3> operands;
    double value;
    FormulaInput input;
  };
  [[nodiscard]] Number keep(const Node& node);
  [[nodiscard]] std::vector<bool> needed(Number result) const;
  [[nodiscard]] std::vector<bool> changing(Index corner) const;  // whether each number changes with the corner

  class Splitter;

  std::vector<Node> nodes_;
  std::vector<Number> positive_;                          // see mark_positive()
  std::unordered_multimap<std::uint64_t, Number> known_;  // numbers by hash of their operation and operands
};

}  // namespace dmoscope
