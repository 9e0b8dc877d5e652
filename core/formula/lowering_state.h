#pragma once
// State of the translation of a formula's body: the values of its expressions so far, and the rules for them. Only the lowering*.cpp
// include it; formula.h is for all others.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/formula/formula.h"
#include "core/formula/vocabulary.h"

// A namespace of its own, since the search has another Value.
namespace dmoscope::formula_lowering {

using Number = ProgramBuilder::Number;
using Vector = ElementNumbers::Vector;

/// Unit of a number as a power of a length; `any` for 0 and for numbers of unknown unit.
struct Dimension {
  double power = 0.0;
  bool any = false;
};

enum class ValueKind : std::uint8_t { OneNumber, OneVector, OneCondition };

struct Value {
  ValueKind kind = ValueKind::OneNumber;
  Vector vector{};  // a number or condition is its first component
  Dimension dimension{};
  double places = 0.0;  // for a vector, the number of places that it is the sum of: 0 for a difference of two
  [[nodiscard]] Number number() const { return vector.at[0]; }
};

/// Words for a kind of value: "a vector".
[[nodiscard]] std::string_view words(ValueKind kind);
/// Words for a unit: "an area".
[[nodiscard]] std::string words(Dimension dimension);

/// Corner or edge at which an expression is computed.
struct Scope {
  std::optional<std::size_t> corner{}, edge{};
  [[nodiscard]] std::pair<std::size_t, std::size_t> key() const { return {corner ? *corner + 1 : 0, edge ? *edge + 1 : 0}; }
};

/// Translates one body for one kind of element, once. `parts`: number of the body's parts that an expression may use, those before it.
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
  /// The value of the whole body, which must be a number.
  Value metric_value();
  /// The program for the number `quality` at places of the moving corner.
  FormulaProgram of_places(Number quality);
  Number steeper(Number quality);

  [[nodiscard]] const SyntaxNode& node(SyntaxId id) const { return syntax_.nodes[id]; }

  // --- Parts and scopes ---

  /// Index of the last part with this name among the first `before`.
  [[nodiscard]] std::optional<std::size_t> part_named(std::string_view name, std::size_t before) const;
  /// Entry of the vocabulary for a name; null: there is none.
  [[nodiscard]] static const FormulaName* name_in_table(std::string_view name);
  /// Whether the expression uses a corner's names outside of aggregates. `parts`: those it may use.
  bool uses_corner(SyntaxId id, std::size_t parts);
  /// The value of the whole body: the least over the corners if it uses a corner's names.
  Value result_value();
  /// The value of an expression, cached, so that a part costs once if many use it.
  Value value_of(SyntaxId id, std::size_t parts, const Scope& scope);
  Value compute(SyntaxId id, std::size_t parts, const Scope& scope);

  // --- Values ---

  static Value number(Number number, Dimension dimension = {}) { return {ValueKind::OneNumber, {{number}, 1}, dimension}; }
  static Value condition(Number number) { return {ValueKind::OneCondition, {{number}, 1}}; }
  Value vector(const Vector& v, double power = 1.0, double places = 0.0) { return {ValueKind::OneVector, v, unit(power), places}; }
  /// Unit of a power of a length; in a target's space numbers have none.
  [[nodiscard]] Dimension unit(double power) const { return {space_ == FormulaSpace::Plain ? power : 0.0, false}; }

  Value number_of(SyntaxId id, std::size_t parts, const Scope& scope);
  Number condition_of(SyntaxId id, std::size_t parts, const Scope& scope);
  /// A vector that is a difference of places or stands for one: a single place is made absolute by the origin.
  Value vector_of(SyntaxId id, std::size_t parts, const Scope& scope);
  /// Calls f, and reports a missing number of the element as an error at `n`.
  template <class F>
  auto known(const SyntaxNode& n, const F& f) -> decltype(f());
  /// The common unit of two values that are added, compared or chosen between.
  Dimension common(Dimension a, Dimension b, const SyntaxNode& n, std::string_view done);
  /// Checks that a value is a plain number, for operations that need one.
  void need_no_unit(const Value& value, const SyntaxNode& n);
  /// Records a reason why the formula changes with the mesh's scale; the first one stays.
  void note_unit(const std::string& what, const SyntaxNode& n);

  // --- Operators ---

  Value negated(Value value, const SyntaxNode& n);
  Value binary(const SyntaxNode& n, Value a, Value b);
  /// The product factor * b; `turned`: -1 if the factor's unit is that of its inverse.
  Value product(Number factor, Dimension of_factor, Value b, const SyntaxNode& n, double turned);
  Value sum(const SyntaxNode& n, const Value& a, const Value& b);
  Value compared(const SyntaxNode& n, const Value& a, const Value& b);
  Value power(const SyntaxNode& n, const Value& base, const Value& exponent);
  /// A power by a constant: whole powers and roots by operations of their own, others by logarithm.
  Number to_the(Number base, double exponent);
  Number whole_power(Number base, unsigned exponent);

  // --- Names ---

  /// Index of a corner's name: 2 for "p3"; none for other names.
  [[nodiscard]] static std::optional<Index> corner_named(std::string_view text);
  /// Indices of a pair's name: 0 and 2 for "l13".
  [[nodiscard]] static std::optional<std::pair<Index, Index>> pair_named(std::string_view text);
  void require_corner(Index corner, const SyntaxNode& n) const;
  Value name(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// Message for a name that is unknown here.
  [[nodiscard]] std::string unknown_name(std::string_view text, std::size_t parts) const;
  /// Value of a name of the vocabulary.
  Value named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope);
  Vector vector_named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope);
  Number number_named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope);
  Number corner_number(const SyntaxNode& n, std::string_view name, std::size_t corner);
  /// Joins the lengths of all edges, or the squares of these.
  Number over_lengths(Operation join, bool squared);

  // --- Calls ---

  void require_arguments(const SyntaxNode& n, const FormulaFunction& function) const;
  Value call(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// Call of a function of one number: abs, sqrt, sin and others.
  Value of_number(const SyntaxNode& n, std::string_view name, const Value& a);
  Number sign(Number x);
  Value arc_tangent(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// Call of min, max or clamp.
  Value extreme(const SyntaxNode& n, std::string_view name, std::size_t parts, const Scope& scope);
  /// Call of if(condition, a, b).
  Value choice(const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// Call of dot, cross, length, x, y or z.
  Value of_vectors(const SyntaxNode& n, std::string_view name, std::size_t parts, const Scope& scope);
  Value field(const SyntaxNode& n);

  // --- Aggregates over corners and edges; `how`: min_corner, mean_edge, ... ---

  /// Aggregate over the corners. `outermost`: the whole formula is this aggregate, so that corners that do not change can be skipped.
  Value over_corners(std::string_view how, SyntaxId id, std::size_t parts, const Scope& scope, bool outermost,
                     const SyntaxNode* n = nullptr);
  Value over_edges(std::string_view how, const SyntaxNode& n, std::size_t parts, const Scope& scope);
  /// Adds one more value to the aggregate.
  void join(std::optional<Value>& all, const Value& one, std::string_view how, const SyntaxNode& n);
  /// Completes an aggregate: a mean is the sum over the count.
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
