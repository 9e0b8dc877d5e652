#include "core/quality/defined_metric.h"

#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

namespace {

constexpr std::string_view kFormula = "formula:", kFormulaFile = "formula:@";

constexpr std::array kNamed{
    NamedFormula{"relative-size", "Relative size", "s = size; if(s > 0, min(s, 1/s), max(s, -1))",
                 "How near elements are to the mesh's mean size, or to the size of their target (Knupp)."},
    NamedFormula{"shape-size", "Shape and size",
                 "triangle, quadrilateral { s = size; 2*det/norm^2 * if(s > 0, min(s, 1/s), 1) } "
                 "tetrahedron, hexahedron, wedge, pyramid { s = size; c = cbrt(det); 3*c*abs(c)/norm^2 * if(s > 0, min(s, 1/s), 1) }",
                 "The mean ratio times the relative size (Knupp)."},
    NamedFormula{"aspect", "Aspect", "sign(det)*smin/smax",
                 "Width over length of what the worst corner makes of the ideal element, or of its target."},
    NamedFormula{"scaled-jacobian-inside", "Scaled Jacobian, inside",
                 "hexahedron, wedge { scaled_jacobian_inside } "
                 "triangle { 2/sqrt(3)*2*area/max_corner(length(u)*length(v)) } quadrilateral { J/(length(u)*length(v)) } "
                 "tetrahedron { sqrt(2)*6*volume/max_corner(length(u)*length(v)*length(w)) } "
                 "pyramid { sqrt(2)*J/(length(u)*length(v)*length(w)) }",
                 "A lower bound of the scaled Jacobian everywhere in an element, not at its corners alone.", 0.5},
};

constexpr std::array<std::string_view, kMetricCount> kBuiltIn{
    // mean-ratio
    "triangle, quadrilateral { 2*det/norm^2 } tetrahedron, hexahedron, wedge, pyramid { c = cbrt(det); 3*c*abs(c)/norm^2 }",
    // mean-ratio-area
    "triangle { 4*sqrt(3)*area/l2sum } quadrilateral { 4*area/l2sum }",
    // radius-ratio
    "triangle { sign(area)*2*inradius/circumradius } tetrahedron { sign(volume)*3*inradius/circumradius }",
    // min-angle
    "triangle { 3/pi*sign(area)*amin } tetrahedron { sign(volume)*amin/acos(1/3) }",
    // max-angle
    "triangle { sign(area)*1.5*(1 - amax/pi) }",
    // rectangularity
    "triangle { a = length(u); b = length(v); sign(area)*max_corner((1 - abs(pi/2 - angle)/(pi/2))*min(a, b)/max(a, b)) }",
    // scaled-jacobian
    "triangle { 2/sqrt(3)*2*area/max_corner(length(u)*length(v)) } quadrilateral { J/(length(u)*length(v)) } "
    "tetrahedron { sqrt(2)*6*volume/max_corner(length(u)*length(v)*length(w)) } hexahedron { J/(length(u)*length(v)*length(w)) } "
    "wedge { 2/sqrt(3)*J/(length(u)*length(v)*length(w)) } pyramid { sqrt(2)*J/(length(u)*length(v)*length(w)) }",
    // aspect-ratio
    "triangle { 4*sqrt(3)*area/(lmax*lsum) } tetrahedron { sign(volume)*2*sqrt(6)*inradius/lmax }",
    // condition
    "quadrilateral { 2*det/norm^2 } tetrahedron, hexahedron, wedge, pyramid { 3*det/(norm*adj) }",
};

/// A formula and a target in a metric's name.
struct NameParts {
  std::string_view metric, target;
  bool has_target;
};
/// At the first '@' outside of quotation marks and comments. Of "formula:@FILE" at the last one, if all of it is no file.
NameParts split(std::string_view name) {
  if (name.starts_with(kFormulaFile)) {
    const std::string_view file = name.substr(kFormulaFile.size());
    const std::size_t at = file.rfind('@');
    std::error_code ignored;
    if (at == std::string_view::npos || std::filesystem::exists(std::filesystem::path(file), ignored)) return {name, {}, false};
    return {name.substr(0, kFormulaFile.size() + at), file.substr(at + 1), true};
  }
  bool quoted = false, comment = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (c == '\n') comment = false;
    if (comment) continue;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '#') comment = true;
    if (c == '@') return {name.substr(0, i), name.substr(i + 1), true};
  }
  return {name, {}, false};
}

/// Reads a formula from a file; errors name the file and the line.
std::shared_ptr<const Formula> formula_in_file(const std::string& path) {
  const std::string text = read_small_text(path, kMostFormulaText);
  try {
    return std::make_shared<const Formula>(text);
  } catch (const FormulaError& error) {
    throw InputError(path, error.place().line, fmt::format("column {}: {}", error.place().column, error.reason()));
  }
}

/// Names and definitions, which never change and never go.
class Definitions {
 public:
  std::optional<Metric> find(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? std::nullopt : std::optional(found->second);
  }
  Metric add(DefinedMetric metric) {
    const std::lock_guard lock(mutex_);
    if (const auto found = by_name_.find(metric.name); found != by_name_.end()) return found->second;
    const auto number = static_cast<Metric>(kMetricCount + all_.size());
    DefinedMetric& kept = all_.emplace_back(std::move(metric));
    describe(kept, number);
    by_name_[kept.name] = number;
    return number;
  }
  const DefinedMetric& at(Metric metric) {
    const std::lock_guard lock(mutex_);
    return all_.at(static_cast<std::size_t>(metric) - kMetricCount);
  }
  std::vector<Metric> all() {
    const std::lock_guard lock(mutex_);
    std::vector<Metric> metrics;
    for (std::size_t i = 0; i < all_.size(); ++i) metrics.push_back(static_cast<Metric>(kMetricCount + i));
    return metrics;
  }

 private:
  static void describe(DefinedMetric& m, Metric number) {
    const MetricInfo* base = m.base ? &info(*m.base) : nullptr;
    constexpr double kFar = 1e3;  // what a scale can still show
    const double lowest = m.facts.least >= -1.0 - 1e-9 ? -1.0 : std::max(m.facts.least, -kFar);
    const double highest = m.facts.greatest <= 1.0 + 1e-9 ? 1.0 : std::min(m.facts.greatest, kFar);
    m.info = {number,
              m.name,
              m.title,
              base != nullptr ? base->lowest : lowest,
              base != nullptr ? base->highest : highest,
              m.acceptable,
              m.formula->text(),
              m.doc,
              base != nullptr ? base->kinds : m.formula->kinds()};
  }

  std::mutex mutex_;
  std::deque<DefinedMetric> all_;  // whose places stay
  std::map<std::string, Metric> by_name_;
};

Definitions& definitions() {
  static Definitions all;
  return all;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 32;
  if (text.size() <= kMost) return text;
  std::size_t end = kMost - 1;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // no letter is cut
  return text.substr(0, end) + "…";
}

/// The metric of a formula that a person wrote.
DefinedMetric of_formula(std::shared_ptr<const Formula> formula) {
  DefinedMetric m;
  m.name = std::string(kFormula) + formula->text();
  m.title = formula->title().empty() ? shortened(formula->text()) : formula->title();
  m.facts = facts_of(*formula);
  m.doc = fmt::format("A formula: {}.", m.facts.summary);
  m.formula = std::move(formula);
  return m;
}

DefinedMetric of_name(const NamedFormula& named) {
  DefinedMetric m;
  m.name = named.name;
  m.title = named.title;
  m.doc = named.doc;
  m.formula = std::make_shared<const Formula>(named.formula);
  m.acceptable = named.acceptable;
  m.facts.least = -1.0;
  m.facts.greatest = 1.0;
  return m;
}

/// A built-in metric as a formula, with no target yet.
DefinedMetric of_built_in(Metric metric) {
  const MetricInfo& known = info(metric);
  DefinedMetric m;
  m.name = known.name;
  m.title = known.title;
  m.doc = known.doc;
  m.base = metric;
  m.acceptable = known.acceptable;
  m.formula = std::make_shared<const Formula>(formula_of(metric));
  m.facts.least = known.lowest;
  m.facts.greatest = known.highest;
  return m;
}

DefinedMetric targeted(DefinedMetric m, const Target& target) {
  m.target = target;
  if (target.is_ideal()) return m;
  const std::string words = to_text(target);
  m.name += "@" + words;
  m.title += " @ " + shortened(words);
  m.doc += fmt::format(" Against the target {}.", words);
  for (const Target::OfGroup& one : target.groups)
    if (one.shape.tolerance > 0.0) {
      m.doc += " Elements that are kept fall far below -1 where they change by more than their tolerance.";
      break;
    }
  return m;
}

/// Without a target.
std::optional<DefinedMetric> without_target(std::string_view name) {
  if (name.starts_with(kFormula)) {
    const std::string text(name.substr(kFormula.size()));
    if (text.starts_with('@')) return of_formula(formula_in_file(text.substr(1)));
    return of_formula(std::make_shared<const Formula>(text));
  }
  const auto named = std::ranges::find(kNamed, name, &NamedFormula::name);
  if (named != kNamed.end()) return of_name(*named);
  const auto table = metric_table();
  const auto built_in = std::ranges::find(table, name, &MetricInfo::name);
  if (built_in != table.end()) return of_built_in(built_in->metric);
  return std::nullopt;
}

}  // namespace

std::span<const NamedFormula> named_formulas() { return kNamed; }

std::string_view formula_of(Metric built_in) { return kBuiltIn[static_cast<std::size_t>(built_in)]; }

const DefinedMetric& defined(Metric metric) { return definitions().at(metric); }

std::vector<Metric> defined_metrics() { return definitions().all(); }

std::optional<Metric> define_metric(std::string_view name) {
  if (const auto known = definitions().find(std::string(name))) return known;
  const NameParts parts = split(name);
  auto metric = without_target(parts.metric);
  if (!metric) return std::nullopt;
  const Target target = parts.has_target ? parse_target(parts.target) : Target{};
  if (target.is_ideal() && metric->base) return *metric->base;
  return definitions().add(targeted(std::move(*metric), target));
}

Metric with_target(Metric metric, const Target& target) {
  DefinedMetric m = is_built_in(metric) ? of_built_in(metric) : defined(metric);
  if (!is_built_in(metric) && !m.target.is_ideal()) {
    const NameParts parts = split(m.name);
    m = *without_target(parts.metric);
  }
  if (target.is_ideal() && m.base) return *m.base;
  return definitions().add(targeted(std::move(m), target));
}

Target target_of(Metric metric) { return is_built_in(metric) ? Target{} : defined(metric).target; }

}  // namespace dmoscope
