#include "core/run/recipe.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/joint/joint_clusters.h"

namespace dmoscope {

namespace {
const double kUsualGap = JointOptions{}.gap;
const std::array<Recipe, 4> kRecipes{
    {{"best", "a minimum within 0.3 % of what can be reached, then the best mean that keeps it", "dmo", "joint,mean", 3e-3},
     {"minimum", "the best minimum, whatever the mean", "dmo", "joint", kUsualGap},
     {"mean", "what single vertices reach, then the best mean that keeps it", "dmo", "mean", kUsualGap},
     {"paper", "the method of the paper alone", "dmo", "nothing", kUsualGap}}};
}  // namespace

std::span<const Recipe> recipe_table() { return kRecipes; }

const Recipe& recipe(std::string_view name) {
  const auto found = std::ranges::find(kRecipes, name, &Recipe::name);
  if (found == kRecipes.end()) throw UsageError(unknown_row("recipe", name, kRecipes));
  return *found;
}

std::string follow_recipe(const Recipe& recipe, const InputMesh& input, RunParameters& parameters, std::optional<double> said_gap) {
  parameters.method = recipe.method;
  parameters.combination.reset();
  parameters.joint_gap = said_gap.value_or(recipe.joint_gap);
  set_then(parameters, recipe.then, {});
  const std::string why_not = parameters.then_joint ? why_not_joint(input, parameters.metric) : std::string();
  if (why_not.empty()) return {};
  parameters.then_joint.reset();
  return fmt::format("the recipe \"{}\" goes without joint moves: {}", recipe.name, why_not);
}

}  // namespace dmoscope
