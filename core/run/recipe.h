#pragma once
// Recipes: chains of phases under one name.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/parameters.h"

namespace dmoscope {

struct Recipe {
  std::string_view name, doc;
  std::string_view method, then;        // see set_then()
  double joint_gap;                     // see RunParameters
  bool raises_scaled_jacobian = false;  // beyond a mean ratio a little above the input's least, unless another metric is said
};
/// Table of all recipes, the recommended one first.
[[nodiscard]] std::span<const Recipe> recipe_table();
/// Recipe of this name. Throws UsageError that lists the known ones.
[[nodiscard]] const Recipe& recipe(std::string_view name);

/// Guard of a mesh of long boxes, which all have nearly right angles and are longer than wide: for their mean ratio rises where they lean.
/// It keeps the scaled Jacobian that 19 of 20 elements have, less a little. None for other meshes.
[[nodiscard]] std::optional<GuardRule> guard_of_long_boxes(const InputMesh& input);

/// Sets method, aims and phases, with a PhaseBegin of its own, and the gap of joint moves unless a person `said_gap`. Where a mean is
/// raised, sets guard_of_long_boxes() in the place of the usual guard. Leaves out what this mesh and metric do not allow. Returns a
/// sentence on each of these; usually none.
[[nodiscard]] std::vector<std::string> follow_recipe(const Recipe& recipe, const InputMesh& input, RunParameters& parameters,
                                                     std::optional<double> said_gap = {});

}  // namespace dmoscope
