#pragma once
// Chains of phases that go by one name.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/run/parameters.h"

namespace dmoscope {

struct Recipe {
  std::string_view name, doc;
  std::string_view method, then;  // see set_then()
  double joint_gap;               // see RunParameters
};
/// The recommended one first.
[[nodiscard]] std::span<const Recipe> recipe_table();
/// Throws UsageError that lists the known ones.
[[nodiscard]] const Recipe& recipe(std::string_view name);

/// Sets method and phases, with a PhaseBegin of its own, and the gap of joint moves, where a person has not `said_gap`. Returns what of it
/// this mesh and metric do not allow, which is left out, in a sentence; usually empty.
[[nodiscard]] std::string follow_recipe(const Recipe& recipe, const InputMesh& input, RunParameters& parameters,
                                        std::optional<double> said_gap = {});

}  // namespace dmoscope
