#include "core/run/recipe.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/joint/joint_clusters.h"

namespace dmoscope {

namespace {
constexpr std::array<Recipe, 4> kRecipes{
    {{"best", "the best minimum that is known how to reach, then the best mean that keeps it", "dmo", "joint,mean"},
     {"minimum", "the best minimum, whatever the mean", "dmo", "joint"},
     {"mean", "what single vertices reach, then the best mean that keeps it", "dmo", "mean"},
     {"paper", "the method of the paper alone", "dmo", "nothing"}}};
}  // namespace

std::span<const Recipe> recipe_table() { return kRecipes; }

const Recipe& recipe(std::string_view name) {
  const auto found = std::ranges::find(kRecipes, name, &Recipe::name);
  if (found == kRecipes.end()) throw UsageError(unknown_row("recipe", name, kRecipes));
  return *found;
}

std::string follow_recipe(const Recipe& recipe, const InputMesh& input, RunParameters& parameters) {
  parameters.method = recipe.method;
  parameters.combination.reset();
  set_then(parameters, recipe.then, {});
  if (!parameters.then_joint) return {};
  try {
    require_joint(input, parameters.metric);
  } catch (const UsageError& error) {
    parameters.then_joint.reset();
    return fmt::format("the recipe \"{}\" goes without joint moves: {}", recipe.name, error.what());
  }
  return {};
}

}  // namespace dmoscope
