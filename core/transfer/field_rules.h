#pragma once
// Rules by which nodal fields belong to places or to vertices.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Rule for a field. Place: a vertex that moved gets the input's value at its new place. Carry: it keeps its value.
enum class FieldRule { Place, Carry };

/// A rule for all fields, and for some by their names.
struct FieldRules {
  FieldRule all = FieldRule::Place;
  std::vector<std::pair<std::string, FieldRule>> named{};
  friend bool operator==(const FieldRules&, const FieldRules&) = default;
};

/// Text of the rules: "place", "carry", "depth=carry,temp=place", "carry,depth=place".
[[nodiscard]] std::string to_text(const FieldRules& rules);
/// Parses such a text. Throws UsageError.
[[nodiscard]] FieldRules parse_field_rules(std::string_view text);
/// Throws UsageError if a rule names a field that no vertex has.
void require_fields(const FieldRules& rules, const Mesh& mesh);

/// Whether a field holds whole numbers: flags, ids and counts, which cannot be interpolated. A depth or an elevation never does.
[[nodiscard]] bool holds_whole_numbers(const Field& field);
/// The rule for a field of vertices: its own, else that for all; without a rule of its own, whole numbers are carried in any case.
[[nodiscard]] FieldRule rule_for(const Field& field, const FieldRules& rules);

}  // namespace dmoscope
