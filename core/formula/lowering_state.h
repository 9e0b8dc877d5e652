#pragma once
// A formula's body on its way to a program: what its expressions are worth so far, and the rules that say so. Only the lowering*.cpp
// include it; lowering.h is for all others.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/formula/lowering.h"
#include "core/formula/vocabulary.h"

// A namespace of its own, for the search knows another Value.
namespace dmoscope::formula_lowering {

using Number = ProgramBuilder::Number;
using Vector = ElementNumbers::Vector;

/// Of what a number is a power of a length; `any` of 0 and of what nobody knows.
struct Dimension {
  double power = 0.0;
  bool any = false;
};

enum class ValueKind : std::uint8_t { OneNumber, OneVector, OneCondition };

struct Value {
  ValueKind kind = ValueKind::OneNumber;
  Vector vector{};  // of a number or condition the first
  Dimension dimension{};
  double places = 0.0;  // of a vector: how many places it is the sum of; of a difference of two 0
  [[nodiscard]] Number number() const { return vector.at[0]; }
};

/// "a vector".
[[nodiscard]] std::string_view words(ValueKind kind);
/// "an area".
[[nodiscard]] std::string words(Dimension dimension);

/// Where an expression is computed: at which corner or edge.
struct Scope {
  std::optional<std::size_t> corner{}, edge{};
  [[nodiscard]] std::pair<std::size_t, std::size_t> key() const { return {corner ? *corner + 1 : 0, edge ? *edge + 1 : 0}; }
};

/// Lowers one body for one kind of element, once. `parts`: how many of the body's parts an expression may use, those before it.
class Lowering {
 public:
  Lowering(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind, FormulaSpace space, FormulaUse use, Index moving,
           std::vector<std::string>& fields)
      : syntax_(syntax),
        body_(body),
        kind_(kind),
        space_(space),
        use_(use),
        moving_(moving),
        fields_(fields),
        element_(builder_, kind, space) {}

  LoweredFormula run();
  std::vector<FormulaPiece> pieces();

 private:
  /// Of the whole body, which must be a number.
  Value metric_value();
  /// What a place of the moving corner is worth.
  FormulaProgram of_places(Number quality);
  Number steeper(Number quality);

  [[nodiscard]] const SyntaxNode& node(SyntaxId id) const { return syntax_.nodes[id]; }

  // Parts and scopes.

  /// The last of the first `before` parts with this name.
  [[nodiscard]] std::optional<std::size_t> part_named(std::string_view name, std::size_t before) const;
  /// A name of the vocabulary; null: there is none.
  [[nodiscard]] static const FormulaName* name_in_table(std::string_view name);
  /// Does the expression use a corner's names outside of what gathers them? `parts`: those it may use.
  bool uses_corner(SyntaxId id, std::size_t parts);
  /// Of the whole body: of what is said corner by corner the least.
  Value result_value();
  /// Memory of what was computed makes a part that many use cost once.
  Value value_of(SyntaxId id, std::size_t parts, const Scope& scope);
  Value compute(SyntaxId id, std::size_t parts, const Scope& scope);

  // Values.

  static Value number(Number number, Dimension dimension = {}) { return {ValueKind::OneNumber, {{number}, 1}, dimension}; }
  static Value condition(Number number) { return {ValueKind::OneCondition, {{number}, 1}}; }
  Value vector(const Vector& v, double power = 1.0, double places = 0.0) { return {ValueKind::OneVector, v, unit(power), places}; }
  /// In a target's space nothing has a unit.
  [[nodiscard]] Dimension unit(double power) const { return {space_ == FormulaSpace::Plain ? power : 0.0, false}; }

  Value number_of(SyntaxId id, std::size_t parts, const Scope& scope);
  Number condition_of(SyntaxId id, std::size_t parts, const Scope& scope);
  /// A difference of places, or what stands for one: with the origin, where it depends on it.
  Value vector_of(SyntaxId id, std::size_t parts, const Scope& scope);
  /// What an element has, or an error that says that it has not.
  template <class F>
  auto known(const SyntaxNode& n, const F& f) -> decltype(f());
  /// Of two that are added, compared or chosen between.
  Dimension common(Dimension a, Dimension b, const SyntaxNode& n, std::string_view done);
  /// Of what has no unit by its nature.
  void need_no_unit(const Value& value, const SyntaxNode& n);
  /// The first reason why the formula changes with the mesh's scale stays.
  void note_unit(const std::string& what, const SyntaxNode& n);

  // Operators.

  Value negated(Value value, const SyntaxNode& n);
  Value binary(const SyntaxNode& n, Value a, Value b);
  /// factor * b; `turned`: -1 where the factor's unit is that of its inverse.
  Value product(Number factor, Dimension of_factor, Value b, const SyntaxNode& n, double turned);
  Value sum(const SyntaxNode& n, const Value& a, const Value& b);
  Value compared(const SyntaxNode& n, const Value& a, const Value& b);
  Value power(const SyntaxNode& n, const Value& base, const Value& exponent);
  /// Whole powers and roots that have operations of their own; others by logarithm.
  Number to_the(Number base, double exponent);
  Number whole_power(Number base, unsigned exponent);

  // Names.

  /// "p3": 2; none where it is no such name.
  [[nodiscard]] static std::optional<Index> corner_named(std::string_view text);
  /// "l13": 0 and 2.
  [[nodiscard]] static std::optional<std::pair<Index, Index>> pair_named(std::string_view text);
  void require_corner(Index corner, const SyntaxNode& n) const;
  Value name(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// What is wrong with a name that is none here.
  [[nodiscard]] std::string unknown_name(std::string_view text, std::size_t parts) const;
  /// A name of the vocabulary.
  Value named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope);
  Vector vector_named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope);
  Number number_named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope);
  Number corner_number(const SyntaxNode& n, std::string_view name, std::size_t corner);
  /// Joins the lengths of all edges, or their squares.
  template <class F>
  Number over_lengths(const F& join, bool squared);

  // Calls.

  void require_arguments(const SyntaxNode& n, const FormulaFunction& function) const;
  Value call(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// abs, sqrt, sin and others of one number.
  Value of_number(const SyntaxNode& n, std::string_view name, const Value& a);
  Number sign(Number x);
  Value arc_tangent(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// min, max and clamp.
  Value extreme(const SyntaxNode& n, std::string_view name, std::size_t parts, const Scope& scope);
  /// if(condition, a, b).
  Value choice(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// dot, cross, length, x, y and z.
  Value of_vectors(const SyntaxNode& n, std::string_view name, std::size_t parts, const Scope& scope);
  Value field(const SyntaxNode& n);

  // What gathers corners and edges; `how`: min_corner, mean_edge, ...

  /// `outermost`: the formula is this, so that corners that do not change need not be looked at.
  Value over_corners(std::string_view how, SyntaxId id, std::size_t parts, const Scope& scope, bool outermost,
                     const SyntaxNode* n = nullptr);
  Value over_edges(std::string_view how, const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// Takes one more into all.
  void join(std::optional<Value>& all, const Value& one, std::string_view how, const SyntaxNode& n);
  /// Of a mean the sum by the count.
  Value finished(Value all, std::string_view how, std::size_t count);

  const FormulaSyntax& syntax_;
  const FormulaBody& body_;
  ElementKind kind_;
  FormulaSpace space_;
  FormulaUse use_;
  Index moving_;
  std::vector<std::string>& fields_;
  ProgramBuilder builder_;
  ElementNumbers element_;
  LoweredFormula lowered_;
  std::map<std::pair<SyntaxId, std::size_t>, bool> uses_corner_;
  std::map<std::tuple<SyntaxId, std::size_t, std::pair<std::size_t, std::size_t>>, Value> values_;
};

}  // namespace dmoscope::formula_lowering
