#pragma once
// Which nodal fields belong to places and which to vertices.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Place: a vertex that moved has what the input has at its new place. Carry: it takes along what it had.
enum class FieldRule { Place, Carry };

/// A rule for all fields, and for some by their names.
struct FieldRules {
  FieldRule all = FieldRule::Place;
  std::vector<std::pair<std::string, FieldRule>> named{};
  friend bool operator==(const FieldRules&, const FieldRules&) = default;
};

/// "place", "carry", "depth=carry,temp=place", "carry,depth=place".
[[nodiscard]] std::string to_text(const FieldRules& rules);
/// Throws UsageError.
[[nodiscard]] FieldRules parse_field_rules(std::string_view text);
/// Throws UsageError where a rule names a field that no vertex has.
void require_fields(const FieldRules& rules, const Mesh& mesh);

/// Whether a field holds whole numbers: flags, ids and counts, between which nothing lies. A depth or an elevation never does.
[[nodiscard]] bool holds_whole_numbers(const Field& field);
/// The rule for a field of vertices: its own, else that for all, by which whole numbers are carried in any case.
[[nodiscard]] FieldRule rule_for(const Field& field, const FieldRules& rules);

}  // namespace dmoscope
