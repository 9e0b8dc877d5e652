#include "core/transfer/field_rules.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/io/reading/binary.h"

namespace dmoscope {
namespace {

std::string_view word_of(FieldRule rule) { return rule == FieldRule::Place ? "place" : "carry"; }

std::optional<FieldRule> rule_of(std::string_view word) {
  if (word == "place") return FieldRule::Place;
  if (word == "carry") return FieldRule::Carry;
  return std::nullopt;
}

const std::pair<std::string, FieldRule>* own_rule(const FieldRules& rules, std::string_view name) {
  const auto found = std::ranges::find(rules.named, name, &std::pair<std::string, FieldRule>::first);
  return found == rules.named.end() ? nullptr : &*found;
}

}  // namespace

std::string to_text(const FieldRules& rules) {
  std::string text(rules.all == FieldRule::Place && !rules.named.empty() ? "" : word_of(rules.all));
  for (const auto& [name, rule] : rules.named) text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, word_of(rule));
  return text;
}

FieldRules parse_field_rules(std::string_view text) {
  FieldRules rules;
  const auto refuse = [](std::string_view word) {
    throw UsageError(fmt::format("'{}' says nothing of fields: choose place, carry, or NAME=place and NAME=carry for some of them", word));
  };
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view word = rest.substr(0, comma);
    const std::size_t equals = word.rfind('=');
    const auto rule = rule_of(equals == std::string_view::npos ? word : word.substr(equals + 1));
    if (!rule || equals == 0) refuse(word);
    if (equals == std::string_view::npos) {
      if (rest.data() != text.data()) refuse(text);  // the rule for all fields must come first
      rules.all = *rule;
    } else {
      const std::string name(word.substr(0, equals));
      if (own_rule(rules, name) != nullptr) throw UsageError(fmt::format("the field '{}' has two rules", name));
      rules.named.emplace_back(name, *rule);
    }
    if (comma == std::string_view::npos) return rules;
    rest.remove_prefix(comma + 1);
  }
}

void require_fields(const FieldRules& rules, const Mesh& mesh) {
  std::vector<std::string_view> names;
  for (const Field& field : mesh.fields)
    if (field.on == Field::On::Vertices) names.push_back(field.name);
  for (const auto& [name, rule] : rules.named) {
    if (std::ranges::find(names, name) != names.end()) continue;
    if (names.empty()) throw UsageError(fmt::format("the mesh has no nodal field '{}', nor any other", name));
    throw UsageError(unknown_value("nodal field", name, names));
  }
}

bool holds_whole_numbers(const Field& field) {
  if (field.role == "depth" || field.role == "elevation") return false;
  ScalarType type = ScalarType::Float64;
  if (field.type == "bit" || (scalar_of_word(field.type, type) && is_whole(type))) return true;
  return std::ranges::all_of(field.values, [](double value) { return value == std::floor(value) || std::isnan(value); });
}

FieldRule rule_for(const Field& field, const FieldRules& rules) {
  if (const auto* own = own_rule(rules, field.name)) return own->second;
  return rules.all == FieldRule::Place && holds_whole_numbers(field) ? FieldRule::Carry : rules.all;
}

}  // namespace dmoscope
