// Calls of functions, and aggregates over corners and edges.

#include <algorithm>

#include <fmt/format.h>

#include "core/base/unknown_value.h"
#include "core/formula/lowering_state.h"

namespace dmoscope::formula_lowering {

// --- Calls ---

void Lowering::require_arguments(const SyntaxNode& n, const FormulaFunction& function) const {
  const int given = static_cast<int>(n.operands.size());
  if (given >= function.least && given <= function.most) return;
  throw FormulaError(n.place, fmt::format("{}({}) takes {} argument{}, not {}", function.name, function.arguments,
                                          function.most > 8 ? fmt::format("1 to {}", function.most) : fmt::format("{}", function.least),
                                          function.least == 1 && function.most == 1 ? "" : "s", given));
}

Value Lowering::call(const SyntaxNode& n, std::size_t parts, const Scope& scope) {
  const auto functions = formula_functions();
  const auto found = std::ranges::find(functions, n.text, &FormulaFunction::name);
  if (found == functions.end()) {
    if (name_in_table(n.text) != nullptr || part_named(n.text, parts) || corner_named(n.text) || pair_named(n.text))
      throw FormulaError(n.place, fmt::format("'{}' is no function; a '*' before the bracket may be missing", n.text));
    throw FormulaError(n.place, unknown_row("function", n.text, functions));
  }
  require_arguments(n, *found);
  const std::string_view name = found->name;
  if (name.ends_with("_corner")) return over_corners(name, n.operands[0], parts, scope, false, &n);
  if (name.ends_with("_edge")) return over_edges(name, n, parts, scope);
  if (name == "field") return field(n);
  if (name == "if") return choice(n, parts, scope);
  if (name == "min" || name == "max" || name == "clamp") return extreme(n, name, parts, scope);
  if (name == "pow") return power(n, number_of(n.operands[0], parts, scope), number_of(n.operands[1], parts, scope));
  if (name == "atan2") return arc_tangent(n, parts, scope);
  if (name == "dot" || name == "cross" || name == "length" || name == "x" || name == "y" || name == "z")
    return of_vectors(n, name, parts, scope);
  return of_number(n, name, number_of(n.operands[0], parts, scope));
}

Value Lowering::of_number(const SyntaxNode& n, std::string_view name, const Value& a) {
  ProgramBuilder& b = builder_;
  const Number x = a.number();
  const auto one = [&b] { return b.constant(1.0); };
  if (name == "abs") return number(b.absolute(x), a.dimension);
  if (name == "sign") return number(sign(x));
  if (name == "sqrt") return number(b.root(x), {0.5 * a.dimension.power, a.dimension.any});
  if (name == "cbrt") return number(b.apply(Operation::CubeRoot, x), {a.dimension.power / 3.0, a.dimension.any});
  need_no_unit(a, n);
  if (name == "exp") return number(b.apply(Operation::Exponential, x));
  if (name == "log") return number(b.apply(Operation::Logarithm, x));
  if (name == "sin") return number(b.apply(Operation::Sine, x));
  if (name == "cos") return number(b.apply(Operation::Cosine, x));
  if (name == "tan") return number(b.divide(b.apply(Operation::Sine, x), b.apply(Operation::Cosine, x)));
  if (name == "atan") return number(b.arc_tangent(x, one()));
  const Number sine = b.maximum(b.constant(-1.0), b.minimum(one(), x)), other = b.root(b.subtract(one(), b.multiply(sine, sine)));
  return number(name == "asin" ? b.arc_tangent(sine, other) : b.arc_tangent(other, sine));
}

Number Lowering::sign(Number x) {
  const Number zero = builder_.constant(0.0), one = builder_.constant(1.0);
  return builder_.select(builder_.less(zero, x), one, builder_.select(builder_.less(x, zero), builder_.constant(-1.0), zero));
}

Value Lowering::arc_tangent(const SyntaxNode& n, std::size_t parts, const Scope& scope) {
  const Value y = number_of(n.operands[0], parts, scope), x = number_of(n.operands[1], parts, scope);
  (void)common(y.dimension, x.dimension, n, "takes the angle of");
  return number(builder_.arc_tangent(y.number(), x.number()));
}

Value Lowering::extreme(const SyntaxNode& n, std::string_view name, std::size_t parts, const Scope& scope) {
  std::vector<Value> all;
  for (const SyntaxId id : n.operands) all.push_back(number_of(id, parts, scope));
  Value result = all[0];
  for (std::size_t i = 1; i < all.size(); ++i) result.dimension = common(result.dimension, all[i].dimension, n, "compares");
  Number x = all[0].number();
  if (name == "clamp") {
    x = builder_.minimum(builder_.maximum(x, all[1].number()), all[2].number());
  } else {
    for (std::size_t i = 1; i < all.size(); ++i)
      x = name == "min" ? builder_.minimum(x, all[i].number()) : builder_.maximum(x, all[i].number());
  }
  result.vector.at[0] = x;
  return result;
}

Value Lowering::choice(const SyntaxNode& n, std::size_t parts, const Scope& scope) {
  const Number condition = condition_of(n.operands[0], parts, scope);
  const Value yes = value_of(n.operands[1], parts, scope), no = value_of(n.operands[2], parts, scope);
  if (yes.kind != no.kind)
    throw FormulaError(n.place, fmt::format("if(...) chooses between {} and {}: both must be the same", words(yes.kind), words(no.kind)));
  if (yes.places != no.places) throw FormulaError(n.place, "if(...) chooses between a place and a difference of places");
  Value result = yes;
  result.dimension = common(yes.dimension, no.dimension, n, "chooses between");
  for (std::size_t i = 0; static_cast<int>(i) < yes.vector.count; ++i)
    result.vector.at[i] = builder_.select(condition, yes.vector.at[i], no.vector.at[i]);
  return result;
}

Value Lowering::of_vectors(const SyntaxNode& n, std::string_view name, std::size_t parts, const Scope& scope) {
  const Value a = vector_of(n.operands[0], parts, scope);
  const Dimension& d = a.dimension;
  if (name == "length") return number(element_.length(a.vector), d);
  if (name == "dot" || name == "cross") {
    const Value b = vector_of(n.operands[1], parts, scope);
    const Dimension both{d.power + b.dimension.power, d.any || b.dimension.any};
    if (name == "dot") return number(element_.dot(a.vector, b.vector), both);
    if (a.vector.count == 2) return number(element_.cross_in_plane(a.vector, b.vector), both);
    return {ValueKind::OneVector, element_.cross_in_space(a.vector, b.vector), both};
  }
  const std::size_t which = name == "x" ? 0 : name == "y" ? 1 : 2;
  if (static_cast<int>(which) >= a.vector.count)
    throw NotForKind(n.place, fmt::format("'z': vectors of a {} have x and y", info(kind_).name));
  return number(a.vector.at[which], d);
}

Value Lowering::field(const SyntaxNode& n) {
  const SyntaxNode& name = node(n.operands[0]);
  if (name.what != Syntax::Text) throw FormulaError(name.place, "a field is named in quotation marks: field(\"depth\")");
  auto found = std::ranges::find(fields_, name.text);
  if (found == fields_.end()) {
    if (fields_.size() >= 16) throw FormulaError(n.place, "a formula reads at most 16 fields");
    fields_.push_back(name.text);
    found = fields_.end() - 1;
  }
  const auto index = static_cast<std::uint8_t>(found - fields_.begin());
  return number(builder_.input({FormulaInput::What::Field, index, 0, 0}), {0.0, true});
}

// --- Aggregates over corners and edges ---

Value Lowering::over_corners(std::string_view how, SyntaxId id, std::size_t parts, const Scope& scope, bool outermost,
                             const SyntaxNode* n) {
  if (scope.corner) throw FormulaError(n != nullptr ? n->place : node(id).place, fmt::format("{} inside of another of its kind", how));
  std::optional<Value> all;
  std::size_t count = 0;
  for (std::size_t corner = 0; corner < element_.frame_count(); ++corner) {
    Scope here = scope;
    here.corner = corner;
    const Value one = number_of(id, parts, here);
    // Skips corners that do not change with the moving one: they say nothing about its place, and the worst of them would hold it there.
    const bool may_stay = outermost && element_.dimension() == 3 && moving_ != kNoIndex && !element_.depends_on(corner, moving_);
    if (may_stay && !builder_.depends_on(one.number(), moving_)) continue;
    join(all, one, how, node(id));
    ++count;
  }
  return finished(*all, how, count);
}

Value Lowering::over_edges(std::string_view how, const SyntaxNode& n, std::size_t parts, const Scope& scope) {
  if (scope.edge) throw FormulaError(n.place, fmt::format("{} inside of another of its kind", how));
  std::optional<Value> all;
  for (std::size_t edge = 0; edge < element_.edges().size(); ++edge) {
    Scope here = scope;
    here.edge = edge;
    join(all, number_of(n.operands[0], parts, here), how, n);
  }
  return finished(*all, how, element_.edges().size());
}

void Lowering::join(std::optional<Value>& all, const Value& one, std::string_view how, const SyntaxNode& n) {
  if (!all) {
    all = one;
    return;
  }
  all->dimension = common(all->dimension, one.dimension, n, "gathers");
  const Number a = all->number(), b = one.number();
  all->vector.at[0] = how.starts_with("min")   ? builder_.minimum(a, b)
                      : how.starts_with("max") ? builder_.maximum(a, b)
                                               : builder_.add(a, b);
}

Value Lowering::finished(Value all, std::string_view how, std::size_t count) {
  if (how.starts_with("mean")) all.vector.at[0] = builder_.times(1.0 / static_cast<double>(count), all.number());
  return all;
}

}  // namespace dmoscope::formula_lowering
