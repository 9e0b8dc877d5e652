// Options by name: the fields of SmoothOptions beside the rows of the program's table of parameters.

#include "library/include/dmoscope/options.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "core/base/thread_count.h"
#include "core/base/unknown_value.h"
#include "core/base/words.h"
#include "core/quality/defined_metric.h"
#include "core/run/parameters.h"
#include "core/run/recipe.h"
#include "core/smooth/composite_objective.h"
#include "library/mesh_data.h"
#include "library/run_request.h"

namespace dmo {

namespace {

using dmoscope::ParameterInfo;
using dmoscope::UsageError;
using Text = const std::string&;

// --- Values as the table's words ---

template <class T>
concept Choice = std::is_enum_v<T>;

template <class T>
std::string text_of(const T& value, const ParameterInfo& row) {
  if constexpr (Choice<T>)
    return std::string(word_of(row.name, value, row.choices));
  else
    return std::to_string(value);
}
std::string text_of(double value, const ParameterInfo& row) {
  return value == 0.0 && row.kind == dmoscope::ParameterKind::Text ? "off" : fmt::format("{}", value);
}
std::string text_of(const std::optional<Guard>& guard, const ParameterInfo&) {
  if (!guard) return "off";
  return fmt::format("{}:{}", guard->metric, guard->floor ? fmt::format("{}", *guard->floor) : "input");
}
std::string text_of(const std::optional<std::uint64_t>& seed, const ParameterInfo&) {
  return dmoscope::to_text(dmoscope::VisitOrder{seed});
}
std::string text_of(const FieldRules& rules, const ParameterInfo&) {
  const auto rule = [](FieldRule one) { return one == FieldRule::Place ? dmoscope::FieldRule::Place : dmoscope::FieldRule::Carry; };
  dmoscope::FieldRules all{rule(rules.all)};
  for (const auto& [name, one] : rules.named) all.named.emplace_back(name, rule(one));
  return to_text(all);
}

void read(int& value, const ParameterInfo&, Text text) { value = std::stoi(text); }
void read(std::uint64_t& value, const ParameterInfo&, Text text) { value = dmoscope::to_count(text); }
void read(double& value, const ParameterInfo&, Text text) { value = text == "off" ? 0.0 : dmoscope::to_number(text); }
template <Choice T>
void read(T& value, const ParameterInfo& row, Text text) {
  value = dmoscope::parse_choice<T>(row.name, text, row.choices);
}
void read(std::optional<Guard>& guard, const ParameterInfo&, Text text) {
  const auto rule = dmoscope::parse_guard(text);
  guard = rule ? std::optional(Guard{std::string(info(rule->metric).name), rule->floor}) : std::nullopt;
}
void read(std::optional<std::uint64_t>& seed, const ParameterInfo&, Text text) { seed = dmoscope::parse_order(text).seed; }
void read(FieldRules& rules, const ParameterInfo&, Text text) {
  const auto rule = [](dmoscope::FieldRule one) { return one == dmoscope::FieldRule::Place ? FieldRule::Place : FieldRule::Carry; };
  const dmoscope::FieldRules parsed = dmoscope::parse_field_rules(text);
  rules = {rule(parsed.all), {}};
  for (const auto& [name, one] : parsed.named) rules.named.emplace_back(name, rule(one));
}

// --- Fields of rows ---

struct RowField {
  std::string_view name;
  std::string (*to_text)(const SmoothOptions&, const ParameterInfo&);
  void (*from_text)(SmoothOptions&, const ParameterInfo&, Text);
};
template <auto kField>
constexpr RowField field(std::string_view name) {
  return {name, [](const SmoothOptions& options, const ParameterInfo& row) { return text_of(options.*kField, row); },
          [](SmoothOptions& options, const ParameterInfo& row, Text text) { read(options.*kField, row, text); }};
}

using O = SmoothOptions;
constexpr std::array kRowFields{field<&O::grid>("grid"),
                                field<&O::levels>("levels"),
                                field<&O::omega>("omega"),
                                field<&O::precision>("precision"),
                                field<&O::simd>("simd"),
                                field<&O::relaxation>("relaxation"),
                                field<&O::directions>("directions"),
                                field<&O::seed>("seed"),
                                field<&O::guard>("guard"),
                                field<&O::order>("order"),
                                field<&O::interfaces>("interfaces"),
                                field<&O::layers>("layers"),
                                field<&O::boundary>("boundary"),
                                field<&O::corner_angle>("corner-angle"),
                                field<&O::feature_angle>("feature-angle"),
                                field<&O::max_deviation>("max-deviation"),
                                field<&O::fit>("fit"),
                                field<&O::joint_gap>("joint-gap"),
                                field<&O::fields>("fields"),
                                field<&O::backend>("backend")};

const RowField& field_of(const ParameterInfo& row) {
  const auto found = std::ranges::find(kRowFields, row.name, &RowField::name);
  if (found == kRowFields.end()) throw UsageError(fmt::format("{}: this option has no field in SmoothOptions", row.name));
  return *found;
}

// --- Other options by name ---

void set_combine(SmoothOptions& options, Text text) {
  const auto [first, terms] = dmoscope::parse_composite(text, {});
  if (options.metric != info(dmoscope::RunParameters{}.metric).name)
    throw UsageError("it names both metrics, so that metric cannot be set");
  options.metric = info(first).name;
  options.combine = SecondAim{terms.threshold, std::string(terms.second_name())};
}
void set_metric(SmoothOptions& options, Text text) {
  if (options.combine) throw UsageError("combine names both metrics");
  options.metric = text;
}
void set_then(SmoothOptions& options, Text text) {
  dmoscope::RunParameters parameters;
  dmoscope::set_then(parameters, text, {});
  options.then_joint = parameters.then_joint.has_value();
  options.then_mean = parameters.then_mean ? std::optional(static_cast<MeanKind>(parameters.mean)) : std::nullopt;
}

bool flag(Text text) {
  constexpr std::array<std::string_view, 2> kWords{"off", "on"};
  return dmoscope::parse_choice<int>("value", text, kWords) == 1;
}

struct OtherOption {
  std::string_view name;
  void (*from_text)(SmoothOptions&, Text);
};
constexpr std::array kOthers{
    OtherOption{"combine", set_combine},
    OtherOption{"corner", [](O& o, Text text) { o.corners.names.push_back(text); }},
    OtherOption{"feature", [](O& o, Text text) { o.features.names.push_back(text); }},
    OtherOption{"fix", [](O& o, Text text) { o.fixed.names.push_back(text); }},
    OtherOption{"iterations", [](O& o, Text text) { o.iterations = dmoscope::to_count(text); }},
    OtherOption{"max-iterations", [](O& o, Text text) { o.max_iterations = dmoscope::to_count(text); }},
    OtherOption{"method", [](O& o, Text text) { o.method = dmoscope::parse_choice<Method>("method", text, method_words()); }},
    OtherOption{"metric", set_metric},
    OtherOption{"no-corner", [](O& o, Text text) { o.no_corners.names.push_back(text); }},
    OtherOption{"no-feature", [](O& o, Text text) { o.no_features.names.push_back(text); }},
    OtherOption{"patience", [](O& o, Text text) { o.patience = dmoscope::to_count(text); }},
    OtherOption{"recipe", [](O& o, Text text) { o.recipe = dmoscope::parse_choice<Recipe>("recipe", text, recipe_words()); }},
    OtherOption{"size-function", [](O& o, Text text) { o.size_function = text; }},
    OtherOption{"slide", [](O& o, Text text) { o.slide.names.push_back(text); }},
    OtherOption{"target", [](O& o, Text text) { o.target = text; }},
    OtherOption{"then", set_then},
    OtherOption{"threads",
                [](O& o, Text text) {
                  const std::uint64_t threads = dmoscope::to_count(text);
                  dmoscope::require_thread_count(threads);
                  o.threads = static_cast<unsigned>(threads);
                }},
    OtherOption{"explain", [](O& o, Text text) { o.explain = flag(text); }},
    OtherOption{"until-converged", [](O& o, Text text) { o.until_converged = flag(text); }}};

[[noreturn]] void refuse_unknown(const std::string& name) {
  std::vector<std::string_view> known;
  for (const OtherOption& other : kOthers) known.push_back(other.name);
  for (const ParameterInfo& row : dmoscope::parameter_table()) known.push_back(row.name);
  std::ranges::sort(known);
  throw UsageError(dmoscope::unknown_value("option", name, known));
}

std::string replaced(std::string_view name, char from, char to) {
  std::string text(name);
  std::ranges::replace(text, from, to);
  return text;
}

const ParameterInfo* find_row(const std::string& name) {
  const auto table = dmoscope::parameter_table();
  const auto found = std::ranges::find(table, replaced(name, '_', '-'), &ParameterInfo::name);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace

void SmoothOptions::set(const std::string& name, const std::string& value) {
  translated([&] {
    if (const ParameterInfo* row = find_row(name)) {
      naming(name, [&] {
        dmoscope::RunParameters parameters;
        row->from_text(parameters, value);
        field_of(*row).from_text(*this, *row, row->to_text(parameters));
      });
      return;
    }
    const auto other = std::ranges::find(kOthers, replaced(name, '_', '-'), &OtherOption::name);
    if (other == kOthers.end()) refuse_unknown(name);
    naming(name, [&] { other->from_text(*this, value); });
  });
}

std::string SmoothOptions::get(const std::string& name) const {
  return translated([&] {
    const ParameterInfo* row = find_row(name);
    if (row == nullptr) refuse_unknown(name);
    return field_of(*row).to_text(*this, *row);
  });
}

void set_parameters(dmoscope::RunParameters& parameters, const SmoothOptions& options) {
  for (const ParameterInfo& row : dmoscope::parameter_table())
    naming(replaced(row.name, '-', '_'), [&] { row.from_text(parameters, field_of(row).to_text(options, row)); });
}

std::vector<Parameter> parameters() {
  std::vector<Parameter> all;
  for (const ParameterInfo& row : dmoscope::parameter_table()) {
    Parameter one{std::string(row.name), std::string(row.type), std::string(row.doc), row.to_text({}), {}, {}, false, {}, {}};
    if (row.kind == dmoscope::ParameterKind::Whole || row.kind == dmoscope::ParameterKind::Real) {
      one.least = row.least;
      one.most = row.most;
      one.open = row.kind == dmoscope::ParameterKind::Real;
    }
    one.choices.assign(row.choices.begin(), row.choices.end());
    for (const dmoscope::MethodInfo& method : dmoscope::method_table())
      if (row.reader == nullptr || method.*row.reader) one.methods.emplace_back(method.name);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace dmo
