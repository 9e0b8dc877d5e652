#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/unknown_value.h"
#include "core/formula/formula.h"
#include "core/formula/lowering_state.h"

namespace dmoscope {

namespace formula_lowering {

std::string_view words(ValueKind kind) {
  return kind == ValueKind::OneNumber ? "a number" : kind == ValueKind::OneVector ? "a vector" : "a condition";
}

std::string words(Dimension dimension) {
  if (dimension.power == 0.0) return "a number without a unit";
  if (dimension.power == 1.0) return "a length";
  if (dimension.power == 2.0) return "an area";
  if (dimension.power == 3.0) return "a volume";
  return fmt::format("a length to the power of {:.4g}", dimension.power);
}

Value Lowering::metric_value() {
  const Value result = result_value();
  if (result.kind != ValueKind::OneNumber)
    throw FormulaError(node(body_.result).place, fmt::format("a metric is a number, and this is {}", words(result.kind)));
  return result;
}

std::vector<FormulaPiece> Lowering::pieces() {
  std::vector<FormulaPiece> all;
  for (const Number piece : builder_.pieces_of(metric_value().number()))
    all.push_back({builder_.finish(kind_, FormulaUse::Elements, kNoIndex, piece), builder_.corners_of(piece)});
  return all;
}

LoweredFormula Lowering::run() {
  const Value result = metric_value();
  if (!result.dimension.any && result.dimension.power != 0.0) {
    lowered_.power = result.dimension.power;
    lowered_.scale_free = false;
  }
  lowered_.program = use_ == FormulaUse::Places ? of_places(result.number()) : builder_.finish(kind_, use_, moving_, result.number());
  return std::move(lowered_);
}

FormulaProgram Lowering::of_places(Number quality) {
  std::optional<Number> ceiling = builder_.ceiling_of(quality, moving_);
  if (space_ == FormulaSpace::Target) {
    quality = steeper(quality);
    if (ceiling) ceiling = steeper(*ceiling);  // monotone even when rounded, since steepness is positive
  }
  const Number sound = builder_.less(builder_.constant(0.0), element_.smallest_jacobian(moving_));
  return builder_.finish(kind_, use_, moving_, builder_.select(sound, quality, builder_.constant(kNeverBest)), ceiling);
}

Number Lowering::steeper(Number quality) {
  const Number one = builder_.constant(1.0), steepness = builder_.input({FormulaInput::What::Steepness, 0, 0, 0});
  return builder_.subtract(one, builder_.multiply(builder_.subtract(one, quality), steepness));
}

// --- Parts and scopes ---

std::optional<std::size_t> Lowering::part_named(std::string_view name, std::size_t before) const {
  for (std::size_t i = before; i-- > 0;)
    if (body_.parts[i].name == name) return i;
  return std::nullopt;
}

const FormulaName* Lowering::name_in_table(std::string_view name) {
  const auto names = formula_names();
  const auto found = std::ranges::find(names, name, &FormulaName::name);
  return found == names.end() ? nullptr : &*found;
}

bool Lowering::uses_corner(SyntaxId id, std::size_t parts) {
  const auto key = std::pair(id, parts);
  if (const auto known = uses_corner_.find(key); known != uses_corner_.end()) return known->second;
  const SyntaxNode& n = node(id);
  bool uses = false;
  if (n.what == Syntax::Name) {
    if (const auto part = part_named(n.text, parts))
      uses = uses_corner(body_.parts[*part].value, *part);
    else if (const FormulaName* name = name_in_table(n.text))
      uses = name->scope == NameScope::Corner;
  } else if (n.what != Syntax::Call || !n.text.ends_with("_corner")) {
    uses = std::ranges::any_of(n.operands, [&](SyntaxId operand) { return uses_corner(operand, parts); });
  }
  return uses_corner_[key] = uses;
}

Value Lowering::result_value() {
  SyntaxId id = body_.result;
  std::size_t parts = body_.parts.size();
  if (uses_corner(id, parts)) return over_corners("min_corner", id, parts, {}, true);
  while (node(id).what == Syntax::Name) {  // a name for the whole body
    const auto part = part_named(node(id).text, parts);
    if (!part) break;
    id = body_.parts[*part].value;
    parts = *part;
  }
  if (node(id).what == Syntax::Call && node(id).text == "min_corner" && node(id).operands.size() == 1)
    return over_corners("min_corner", node(id).operands[0], parts, {}, true);
  if (node(id).what == Syntax::Name && node(id).text == "scaled_jacobian_inside")  // holds for the whole element, not corner by corner
    return number(known(node(id), [&] { return element_.scaled_jacobian_inside(moving_); }));
  return value_of(id, parts, {});
}

Value Lowering::value_of(SyntaxId id, std::size_t parts, const Scope& scope) {
  const auto key = std::tuple(id, parts, scope.key());
  if (const auto known = values_.find(key); known != values_.end()) return known->second;
  const Value value = compute(id, parts, scope);
  values_.emplace(key, value);
  return value;
}

Value Lowering::compute(SyntaxId id, std::size_t parts, const Scope& scope) {
  const SyntaxNode& n = node(id);
  switch (n.what) {
    case Syntax::Number:
      return number(builder_.constant(n.number), {0.0, n.number == 0.0});
    case Syntax::Text:
      throw FormulaError(n.place, "a text is the name of a field: field(\"name\")");
    case Syntax::Name:
      return name(n, parts, scope);
    case Syntax::Call:
      return call(n, parts, scope);
    case Syntax::Not:
      return condition(builder_.subtract(builder_.constant(1.0), condition_of(n.operands[0], parts, scope)));
    case Syntax::Negate:
      return negated(value_of(n.operands[0], parts, scope), n);
    case Syntax::And:
    case Syntax::Or: {
      const Number a = condition_of(n.operands[0], parts, scope), b = condition_of(n.operands[1], parts, scope);
      return condition(n.what == Syntax::And ? builder_.minimum(a, b) : builder_.maximum(a, b));
    }
    case Syntax::Power:
      return power(n, number_of(n.operands[0], parts, scope), number_of(n.operands[1], parts, scope));
    default:
      return binary(n, value_of(n.operands[0], parts, scope), value_of(n.operands[1], parts, scope));
  }
}

// --- Values ---

Value Lowering::number_of(SyntaxId id, std::size_t parts, const Scope& scope) {
  const Value value = value_of(id, parts, scope);
  if (value.kind != ValueKind::OneNumber)
    throw FormulaError(node(id).place, fmt::format("a number is needed here, and this is {}", words(value.kind)));
  return value;
}

Number Lowering::condition_of(SyntaxId id, std::size_t parts, const Scope& scope) {
  const Value value = value_of(id, parts, scope);
  if (value.kind != ValueKind::OneCondition)
    throw FormulaError(node(id).place, fmt::format("a condition such as 'a < b' is needed here, and this is {}", words(value.kind)));
  return value.number();
}

Value Lowering::vector_of(SyntaxId id, std::size_t parts, const Scope& scope) {
  Value value = value_of(id, parts, scope);
  if (value.kind != ValueKind::OneVector)
    throw FormulaError(node(id).place, fmt::format("a vector such as p2 - p1 is needed here, and this is {}", words(value.kind)));
  if (value.places != 0.0) {
    lowered_.uses_place = true;
    const Vector origin = known(node(id), [&] { return element_.origin(); });
    value.vector = element_.add(value.vector, element_.scaled(builder_.constant(value.places), origin));
    value.places = 0.0;
  }
  return value;
}

template <class F>
auto Lowering::known(const SyntaxNode& n, const F& f) -> decltype(f()) {
  try {
    return f();
  } catch (const NoSuchNumber& none) {
    throw NotForKind(n.place, fmt::format("'{}': a {} {}", n.text, info(kind_).name, none.why));
  }
}

Dimension Lowering::common(Dimension a, Dimension b, const SyntaxNode& n, std::string_view done) {
  if (a.any) return b;
  if (b.any || std::abs(a.power - b.power) < 1e-9) return a;
  note_unit(fmt::format("it {} {} and {}", done, words(a), words(b)), n);
  return {0.0, true};
}

void Lowering::need_no_unit(const Value& value, const SyntaxNode& n) {
  if (value.dimension.any || std::abs(value.dimension.power) < 1e-9) return;
  note_unit(fmt::format("it takes '{}' of {}", n.text, words(value.dimension)), n);
}

void Lowering::note_unit(const std::string& what, const SyntaxNode& n) {
  lowered_.scale_free = false;
  if (!lowered_.scale_note.empty()) return;
  const std::string line = n.place.line > 1 ? fmt::format("line {}, ", n.place.line) : std::string();
  lowered_.scale_note = fmt::format("{} ({}column {})", what, line, n.place.column);
}

// --- Operators ---

Value Lowering::negated(Value value, const SyntaxNode& n) {
  if (value.kind == ValueKind::OneCondition) throw FormulaError(n.place, "'-' of a condition makes no sense: '!' turns one round");
  value.vector = element_.scaled(builder_.constant(-1.0), value.vector);
  value.places = -value.places;
  return value;
}

Value Lowering::binary(const SyntaxNode& n, Value a, Value b) {
  const bool comparison = n.what == Syntax::Less || n.what == Syntax::LessOrEqual || n.what == Syntax::Greater ||
                          n.what == Syntax::GreaterOrEqual || n.what == Syntax::Equal || n.what == Syntax::NotEqual;
  if (a.kind == ValueKind::OneCondition || b.kind == ValueKind::OneCondition)
    throw FormulaError(n.place, "conditions are joined with '&&' and '||', and used in if(condition, a, b)");
  if (comparison) return compared(n, a, b);
  switch (n.what) {
    case Syntax::Add:
    case Syntax::Subtract:
      return sum(n, a, b);
    case Syntax::Multiply:
      if (a.kind == ValueKind::OneVector && b.kind == ValueKind::OneVector)
        throw FormulaError(n.place, "two vectors are multiplied by dot(a, b) or cross(a, b)");
      if (a.kind == ValueKind::OneVector) std::swap(a, b);
      return product(a.number(), a.dimension, b, n, 1.0);
    default: {
      if (b.kind == ValueKind::OneVector) throw FormulaError(n.place, "nothing is divided by a vector");
      if (a.kind == ValueKind::OneNumber) {
        const Dimension dimension{a.dimension.power - b.dimension.power, a.dimension.any || b.dimension.any};
        return number(builder_.divide(a.number(), b.number()), dimension);
      }
      return product(builder_.divide(builder_.constant(1.0), b.number()), b.dimension, a, n, -1.0);
    }
  }
}

Value Lowering::product(Number factor, Dimension of_factor, Value b, const SyntaxNode& n, double turned) {
  const double* constant = builder_.value_of(factor);
  if (b.places != 0.0) {
    if (constant == nullptr)
      throw FormulaError(n.place, "a place times a number that varies makes no sense: take differences of places first");
    b.places *= *constant;
  }
  b.vector = element_.scaled(factor, b.vector);
  b.dimension = {b.dimension.power + turned * of_factor.power, b.dimension.any || of_factor.any};
  return b;
}

Value Lowering::sum(const SyntaxNode& n, const Value& a, const Value& b) {
  if (a.kind != b.kind) throw FormulaError(n.place, fmt::format("{} and {} cannot be added", words(a.kind), words(b.kind)));
  const bool plus = n.what == Syntax::Add;
  Value result = a;
  result.dimension = common(a.dimension, b.dimension, n, plus ? "adds" : "subtracts");
  result.vector = plus ? element_.add(a.vector, b.vector) : element_.subtract(a.vector, b.vector);
  result.places = plus ? a.places + b.places : a.places - b.places;
  return result;
}

Value Lowering::compared(const SyntaxNode& n, const Value& a, const Value& b) {
  if (a.kind != ValueKind::OneNumber || b.kind != ValueKind::OneNumber)
    throw FormulaError(n.place, "vectors cannot be compared: their lengths can");
  (void)common(a.dimension, b.dimension, n, "compares");
  const Number x = a.number(), y = b.number();
  switch (n.what) {
    case Syntax::Less:
      return condition(builder_.apply(Operation::Less, x, y));
    case Syntax::LessOrEqual:
      return condition(builder_.apply(Operation::LessOrEqual, x, y));
    case Syntax::Greater:
      return condition(builder_.apply(Operation::Less, y, x));
    case Syntax::GreaterOrEqual:
      return condition(builder_.apply(Operation::LessOrEqual, y, x));
    case Syntax::Equal:
      return condition(builder_.apply(Operation::Equal, x, y));
    default:
      return condition(builder_.subtract(builder_.constant(1.0), builder_.apply(Operation::Equal, x, y)));
  }
}

Value Lowering::power(const SyntaxNode& n, const Value& base, const Value& exponent) {
  const double* constant = builder_.value_of(exponent.number());
  if (constant == nullptr) {
    SyntaxNode of = n;
    of.text.assign(1, '^');
    need_no_unit(base, of);
    need_no_unit(exponent, of);
    return number(builder_.apply(Operation::Power, base.number(), exponent.number()));
  }
  const Dimension dimension{base.dimension.power * *constant, base.dimension.any};
  return number(to_the(base.number(), *constant), dimension);
}

Number Lowering::to_the(Number base, double exponent) {
  if (exponent < 0.0) return builder_.divide(builder_.constant(1.0), to_the(base, -exponent));
  const double thirds = 3.0 * exponent, halves = 2.0 * exponent;
  if (exponent == std::floor(exponent) && exponent <= 64.0) return whole_power(base, static_cast<unsigned>(exponent));
  if (halves == std::floor(halves) && halves <= 64.0) return whole_power(builder_.root(base), static_cast<unsigned>(halves));
  if (std::abs(thirds - std::round(thirds)) < 1e-12 && thirds <= 64.0) {
    const Number positive = builder_.maximum(base, builder_.constant(0.0));
    return whole_power(builder_.apply(Operation::CubeRoot, positive), static_cast<unsigned>(std::round(thirds)));
  }
  return builder_.apply(Operation::Power, base, builder_.constant(exponent));
}

Number Lowering::whole_power(Number base, unsigned exponent) {
  if (exponent == 0) return builder_.constant(1.0);
  const Number half = whole_power(base, exponent / 2), square = exponent < 2 ? half : builder_.multiply(half, half);
  return exponent % 2 == 0 ? square : exponent < 2 ? base : builder_.multiply(square, base);
}

// --- Names ---

std::optional<Index> Lowering::corner_named(std::string_view text) {
  if (text.size() != 2 || text[0] != 'p' || text[1] < '1' || text[1] > '8') return std::nullopt;
  return static_cast<Index>(text[1] - '1');
}

std::optional<std::pair<Index, Index>> Lowering::pair_named(std::string_view text) {
  if (text.size() != 3 || text[0] != 'l' || text[1] < '1' || text[1] > '8' || text[2] < '1' || text[2] > '8') return std::nullopt;
  return std::pair(static_cast<Index>(text[1] - '1'), static_cast<Index>(text[2] - '1'));
}

void Lowering::require_corner(Index corner, const SyntaxNode& n) const {
  if (corner >= element_.corner_count())
    throw NotForKind(n.place, fmt::format("'{}': a {} has only {} corners", n.text, info(kind_).name, element_.corner_count()));
}

Value Lowering::name(const SyntaxNode& n, std::size_t parts, const Scope& scope) {
  if (const auto part = part_named(n.text, parts)) return value_of(body_.parts[*part].value, *part, scope);
  if (const FormulaName* entry = name_in_table(n.text)) return named(n, *entry, scope);
  if (const auto corner = corner_named(n.text)) {
    require_corner(*corner, n);
    return vector(known(n, [&] { return element_.place(*corner); }), 1.0, 1.0);
  }
  if (const auto ends = pair_named(n.text)) {
    require_corner(std::max(ends->first, ends->second), n);
    if (ends->first == ends->second) throw FormulaError(n.place, fmt::format("'{}' is no length: its ends are one corner", n.text));
    return number(known(n, [&] { return element_.length(element_.edge(ends->first, ends->second)); }), unit(1.0));
  }
  throw FormulaError(n.place, unknown_name(n.text, parts));
}

std::string Lowering::unknown_name(std::string_view text, std::size_t parts) const {
  const auto functions = formula_functions();
  if (std::ranges::find(functions, text, &FormulaFunction::name) != functions.end())
    return fmt::format("'{}' is a function, and its arguments in brackets are missing", text);
  for (std::size_t i = parts; i < body_.parts.size(); ++i)
    if (body_.parts[i].name == text) return fmt::format("'{}' has its value only further on", text);
  std::vector<std::string_view> names;
  for (const FormulaName& name : formula_names()) names.push_back(name.name);
  for (std::size_t i = 0; i < parts; ++i) names.push_back(body_.parts[i].name);
  const auto near = closest_word(text, names);
  return fmt::format("unknown name '{}'{}", text, near ? fmt::format("; did you mean {}?", *near) : std::string());
}

Value Lowering::named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope) {
  if (entry.scope == NameScope::Corner && !scope.corner)
    throw FormulaError(n.place, fmt::format("'{}' is of a corner: gather it with min_corner(...) or another of its kind", n.text));
  if (entry.scope == NameScope::Edge && !scope.edge)
    throw FormulaError(n.place, fmt::format("'{}' is of an edge: gather it with min_edge(...) or another of its kind", n.text));
  const int dimension = element_.dimension();
  const double power = entry.name == "adj" ? dimension - 1.0 : entry.power < 0 ? dimension : entry.power;
  if (entry.is_vector) return vector(known(n, [&] { return vector_named(n, entry, scope); }));
  return number(known(n, [&] { return number_named(n, entry, scope); }), entry.name == "pi" ? Dimension{} : unit(power));
}

Vector Lowering::vector_named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope) {
  if (entry.name == "e") {
    const auto [from, to] = element_.edges()[*scope.edge];
    return element_.edge(from, to);
  }
  const std::size_t which = entry.name == "u" ? 0 : entry.name == "v" ? 1 : 2;
  if (static_cast<int>(which) >= element_.dimension())
    throw NotForKind(n.place, fmt::format("'w': a {} has two edges at a corner", info(kind_).name));
  return element_.corner(*scope.corner).edges[which];
}

Number Lowering::number_named(const SyntaxNode& n, const FormulaName& entry, const Scope& scope) {
  const std::string_view name = entry.name;
  const bool volume = element_.dimension() == 3;
  if (name == "pi") return builder_.constant(std::numbers::pi);
  if (name == "area" && volume) throw NotForKind(n.place, fmt::format("'area': a {} has a volume", info(kind_).name));
  if (name == "volume" && !volume) throw NotForKind(n.place, fmt::format("'volume': a {} has an area", info(kind_).name));
  if (name == "perimeter" && volume) throw NotForKind(n.place, fmt::format("'perimeter': a {} has none", info(kind_).name));
  if (name == "area" || name == "volume" || name == "measure") return element_.measure();
  if (name == "surface") return element_.surface();
  if (name == "perimeter" || name == "lsum") return over_lengths(Operation::Add, false);
  if (name == "lmin") return builder_.root(over_lengths(Operation::Minimum, true));
  if (name == "lmax") return builder_.root(over_lengths(Operation::Maximum, true));
  if (name == "l2sum") return over_lengths(Operation::Add, true);
  if (name == "amin") return element_.least_angle();
  if (name == "amax") return element_.greatest_angle();
  if (name == "inradius") return element_.inradius();
  if (name == "circumradius") return element_.circumradius();
  if (name == "scaled_jacobian_inside") return element_.scaled_jacobian_inside(kNoIndex);
  if (name == "mean_measure") {
    if (space_ != FormulaSpace::Plain) throw NoSuchNumber{"is measured against its target here: 'size' says how large it is"};
    return element_.mean_measure();
  }
  if (entry.scope == NameScope::Edge) {
    if (name == "dihedral") return element_.dihedral_angle(*scope.edge);
    const auto [from, to] = element_.edges()[*scope.edge];
    return element_.length(element_.edge(from, to));
  }
  return corner_number(n, name, *scope.corner);
}

Number Lowering::corner_number(const SyntaxNode& n, std::string_view name, std::size_t corner) {
  if (name == "J") return element_.corner(corner).jacobian;
  if (name == "angle") return element_.corner_angle(corner);
  if (name == "det") return element_.determinant(corner);
  if (name == "norm") return builder_.root(element_.squared_norm(corner));
  if (name == "adj") return element_.adjugate_norm(corner);
  if (name == "size") return element_.relative_size(corner);
  if (name == "smid" && element_.dimension() == 2)
    throw NotForKind(n.place, fmt::format("'smid': a {} has two singular values, smax and smin", info(kind_).name));
  return element_.singular_value(corner, name == "smax" ? 0 : name == "smid" ? 1 : element_.dimension() - 1);
}

Number Lowering::over_lengths(Operation join, bool squared) {
  std::optional<Number> all;
  for (const auto& [from, to] : element_.edges()) {
    const Vector e = element_.edge(from, to);
    const Number one = squared ? element_.dot(e, e) : element_.length(e);
    all = all ? builder_.apply(join, *all, one) : one;
  }
  return *all;
}

}  // namespace formula_lowering

LoweredFormula lower(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind, FormulaSpace space, FormulaUse use,
                     Index moving, std::vector<std::string>& fields) {
  return formula_lowering::Lowering(syntax, body, kind, space, use, moving, fields).run();
}

std::vector<FormulaPiece> lower_pieces(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind, FormulaSpace space,
                                       std::vector<std::string>& fields) {
  return formula_lowering::Lowering(syntax, body, kind, space, FormulaUse::Elements, kNoIndex, fields).pieces();
}

}  // namespace dmoscope
