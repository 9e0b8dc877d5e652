#pragma once
// Puts a program together: the same number is computed once, constants are computed beforehand, and what no result needs is left out.

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/formula/program.h"

namespace dmoscope {

class ProgramBuilder {
 public:
  using Number = std::uint32_t;  // that the program computes

  [[nodiscard]] Number constant(double value);
  [[nodiscard]] Number input(FormulaInput input);
  [[nodiscard]] Number apply(Operation operation, Number a, Number b = 0, Number c = 0);
  [[nodiscard]] const double* value_of(Number number) const;  // null: no constant
  /// Does the number change with the element's corner?
  [[nodiscard]] bool depends_on(Number number, Index corner) const;
  /// Of a minimum the least of its parts that do not change with the corner: the number is never above it. None where all parts change.
  [[nodiscard]] std::optional<Number> ceiling_of(Number number, Index corner);

  // What formulas and their vocabulary are written with.
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

  /// Promises that the number is above 0 in every element that is not inverted.
  void mark_positive(Number number);
  /// Numbers whose least is this one in every element that is not inverted, as smooth as can be: the parts of a minimum, also where a
  /// function that only rises is taken of it, or one that only falls of a maximum. Each once; the number alone where it has no such parts.
  [[nodiscard]] std::vector<Number> pieces_of(Number number);
  /// The element's corners that the number depends on, a bit each.
  [[nodiscard]] std::uint8_t corners_of(Number number) const;

  /// The program whose result this is; see FormulaProgram.
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
  [[nodiscard]] std::vector<bool> changing(Index corner) const;  // which numbers change with the corner

  class Splitter;

  std::vector<Node> nodes_;
  std::vector<Number> positive_;                          // see mark_positive()
  std::unordered_multimap<std::uint64_t, Number> known_;  // by what they are made of
};

}  // namespace dmoscope
