#include "core/quality/formula_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/mesh/random.h"
#include "core/quality/element_shape.h"
#include "core/quality/formula_values.h"
#include "core/quality/formulas.h"

namespace dmoscope {

namespace {

using Corners = std::array<Vec3, 8>;

/// The ideal element with edges of length 1.
Corners ideal_corners(ElementKind kind) {
  const double h = 0.5 * std::numbers::sqrt3;
  switch (kind) {
    case ElementKind::Triangle:
      return {{{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}}};
    case ElementKind::Quadrilateral:
      return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    case ElementKind::Tetrahedron:
      return {{{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0.5, h / 3.0, std::sqrt(2.0 / 3.0)}}};
    case ElementKind::Hexahedron:
      return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    case ElementKind::Wedge:
      return {{{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, h, 1}}};
    case ElementKind::Pyramid:
      break;
  }
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}}};
}

double coordinate(Vec3 p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double jacobian_of(ElementKind kind, const Corners& p) {
  const auto at = [&p](Index v) { return p[v]; };
  constexpr std::array<Index, 8> kInOrder{0, 1, 2, 3, 4, 5, 6, 7};
  const auto corners = std::span(kInOrder).first(info(kind).corners);
  const auto smallest = [](const auto& shape) { return formulas::smallest_jacobian(shape); };
  return info(kind).dimension == 3 ? visit_volume(corners, at, smallest) : visit_planar(Plane{}, corners, at, smallest);
}

/// Evaluates a formula on elements of one kind, up to kFormulaBatch at once; a value that overflows counts as -1, and is noted.
class Sampler {
 public:
  Sampler(const Formula& formula, ElementKind kind)
      : program_(formula.program(kind, FormulaSpace::Plain, FormulaUse::Elements, kNoIndex)), kind_(kind) {}

  [[nodiscard]] double value(const Corners& corners) {
    double value = 0.0;
    judge({&corners, 1}, &value);
    return value;
  }
  void judge(std::span<const Corners> elements, double* out) {
    FormulaValues values(program_);
    for (std::size_t i = 0; i < elements.size(); ++i)
      values.set(i, [&](const FormulaInput& input) {
        switch (input.what) {
          case FormulaInput::What::Corner:
            return coordinate(elements[i][input.index], input.row);
          case FormulaInput::What::MeanMeasure:
            return ideal_measure(kind_);
          case FormulaInput::What::Field:
            return 1.0;
          default:
            return 0.0;
        }
      });
    values.run();
    for (std::size_t i = 0; i < elements.size(); ++i) {
      out[i] = values.quality(i);
      if (std::isfinite(out[i])) continue;
      out[i] = -1.0;
      overflows_ = true;
    }
  }
  [[nodiscard]] bool overflows() const { return overflows_; }
  /// How many elements are worth a look: fewer where each takes long.
  [[nodiscard]] std::size_t samples() const {
    constexpr std::size_t kMost = 3072, kLeast = 256, kSteps = 400'000;
    return std::clamp(kSteps / (program_.steps.size() + 1), kLeast, kMost) / kFormulaBatch * kFormulaBatch;
  }

 private:
  const FormulaProgram& program_;
  ElementKind kind_;
  bool overflows_ = false;
};

Corners drawn(ElementKind kind, const Corners& ideal, bool stretched, Random& random) {
  Corners p = ideal;
  const double reach = 0.02 * std::pow(100.0, random.between(0.0, 1.0));  // a little moved to far beyond
  const double wide = std::pow(30.0, random.between(-1.0, 1.0)), high = std::pow(30.0, random.between(-1.0, 1.0));
  for (std::size_t c = 0; c < info(kind).corners; ++c) {
    const auto moved = [&](double x) { return x + reach * random.between(-1.0, 1.0); };
    const double x = moved(p[c].x), y = moved(p[c].y), z = info(kind).dimension == 3 ? moved(p[c].z) : 0.0;
    p[c] = stretched ? Vec3{wide * x, high * y, z} : Vec3{x, y, z};
  }
  return p;
}

FormulaFacts::OfKind sample(const Formula& formula, ElementKind kind) {
  Sampler sampler(formula, kind);
  const Corners ideal = ideal_corners(kind);
  FormulaFacts::OfKind facts{kind, sampler.value(ideal)};
  facts.least = facts.greatest = facts.ideal;
  facts.greatest_inverted = -std::numeric_limits<double>::infinity();
  Random random(20181 + static_cast<std::uint64_t>(kind));
  std::vector<Corners> elements(kFormulaBatch);
  std::vector<double> values(kFormulaBatch);
  for (std::size_t first = 0; first < sampler.samples(); first += kFormulaBatch) {
    for (std::size_t i = 0; i < kFormulaBatch; ++i) elements[i] = drawn(kind, ideal, i % 2 != 0, random);
    sampler.judge(elements, values.data());
    for (std::size_t i = 0; i < kFormulaBatch; ++i) {
      facts.least = std::min(facts.least, values[i]);
      facts.greatest = std::max(facts.greatest, values[i]);
      if (jacobian_of(kind, elements[i]) <= 0.0) facts.greatest_inverted = std::max(facts.greatest_inverted, values[i]);
    }
  }
  facts.overflows = sampler.overflows();
  return facts;
}

std::string short_number(double value) { return fmt::format("{:.4g}", std::abs(value) < 1e-9 ? 0.0 : value); }

}  // namespace

double value_of_stretched(const Formula& formula, ElementKind kind, double ratio) {
  Corners corners = ideal_corners(kind);
  const int n = info(kind).dimension;
  const double across = std::pow(ratio, -1.0 / n), along = across * ratio;
  for (Vec3& p : corners) p = {along * p.x, across * p.y, n == 3 ? across * p.z : 0.0};
  return Sampler(formula, kind).value(corners);
}

FormulaFacts facts_of(const Formula& formula) {
  constexpr double kRoom = 1e-6;  // of rounding
  FormulaFacts facts;
  facts.least = std::numeric_limits<double>::infinity();
  facts.greatest = -facts.least;
  std::string ideals;
  const KindSet kinds = formula.kinds();
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    if (!contains(kinds, kind)) continue;
    const FormulaFacts::OfKind one = sample(formula, kind);
    facts.least = std::min(facts.least, one.least);
    facts.greatest = std::max(facts.greatest, one.greatest);
    const std::string_view name = info(kind).name;
    if (one.overflows) facts.warnings.push_back(fmt::format("some {} have no value by it: numbers become too large", info(kind).plural));
    if (one.greatest - one.least < kRoom)
      facts.warnings.push_back(fmt::format("it is the same for every {}: nothing can be improved by it", name));
    if (std::abs(one.ideal - 1.0) > kRoom)
      facts.warnings.push_back(fmt::format("the ideal {} has {}, and should have 1", name, short_number(one.ideal)));
    if (one.greatest > std::max(one.ideal, 1.0) + kRoom)
      facts.warnings.push_back(
          fmt::format("a {} has {}, more than {}", name, short_number(one.greatest), one.ideal >= 1.0 - kRoom ? "the ideal one" : "1"));
    if (one.greatest_inverted > kRoom)
      facts.warnings.push_back(
          fmt::format("an inverted {} has up to {}, and should have 0 or less", name, short_number(one.greatest_inverted)));
    ideals += fmt::format("{}{} for the ideal {}", ideals.empty() ? "" : ", ", short_number(one.ideal), name);
    facts.kinds.push_back(one);
  }
  const auto as_first = [&](const auto& one) { return short_number(one.ideal) == short_number(facts.kinds.front().ideal); };
  if (facts.kinds.size() > 1 && std::all_of(facts.kinds.begin(), facts.kinds.end(), as_first))
    ideals = fmt::format("{} for every ideal element", short_number(facts.kinds.front().ideal));
  if (!formula.scale_free()) facts.warnings.push_back(fmt::format("it changes with the mesh's unit of length: {}", formula.scale_note()));
  if (formula.uses_place()) facts.warnings.emplace_back("it depends on where elements lie, not on their shapes alone");
  const char* scale = !formula.scale_free() ? "not scale-free" : formula.uses_fields() ? "scale-free if its fields are" : "scale-free";
  facts.summary = fmt::format("{}; {}; from {} to {}", scale, ideals, short_number(facts.least), short_number(facts.greatest));
  return facts;
}

}  // namespace dmoscope
