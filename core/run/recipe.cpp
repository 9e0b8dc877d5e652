#include "core/run/recipe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/joint/joint_clusters.h"
#include "core/quality/quality.h"
#include "core/run/percentiles.h"

namespace dmoscope {

namespace {
const double kUsualGap = JointOptions{}.gap;
const std::array<Recipe, 5> kRecipes{
    {{"best", "a minimum within 0.3 % of what can be reached, then the best mean that keeps it", "dmo", "joint,mean", 3e-3},
     {"hex", "for hexahedra: shapes a third better than the worst one's, then the best scaled Jacobian that keeps them, then the mean",
      "dmo", "joint,mean", 3e-3, true},
     {"minimum", "the best minimum, whatever the mean", "dmo", "joint", kUsualGap},
     {"mean", "what single vertices reach, then the best mean that keeps it", "dmo", "mean", kUsualGap},
     {"paper", "the method of the paper alone", "dmo", "nothing", kUsualGap}}};

/// Threshold of the mean ratio beyond which the scaled Jacobian is raised: what an element can give up for that without becoming as bad as
/// the worst one was. That of a tangled mesh is a small one.
double mean_ratio_to_reach(const InputMesh& input) {
  constexpr double kAbove = 1.3, kMost = 0.3, kTangled = 0.05;
  const auto least =
      compute_statistics(input.quality_context(), input.mesh.positions, Metric::MeanRatio, std::span<const Index>(), nullptr).minimum;
  return least > 0.0 ? std::min(kAbove * least, kMost) : kTangled;
}
}  // namespace

std::span<const Recipe> recipe_table() { return kRecipes; }

const Recipe& recipe(std::string_view name) {
  const auto found = std::ranges::find(kRecipes, name, &Recipe::name);
  if (found == kRecipes.end()) throw UsageError(unknown_row("recipe", name, kRecipes));
  return *found;
}

std::optional<GuardRule> guard_of_long_boxes(const InputMesh& input) {
  constexpr double kBoxes = 0.85, kLong = 0.9;
  constexpr double kRoom = 0.0025;  // half of what the report card lets a quality fall; without any, a box could not move
  const QualityContext context = input.quality_context();
  const std::span<const Vec3> positions = input.mesh.positions;
  std::vector<double> angles(input.mesh.elements.size());
  element_qualities(context, positions, Metric::ScaledJacobian, nullptr, angles);
  if (std::ranges::any_of(angles, [](double q) { return !(q >= kBoxes); })) return std::nullopt;
  const double most_have = percentiles_of(angles).p5;
  if (!(compute_percentiles(context, positions, Metric::MeanRatio, nullptr).p5 < kLong * most_have)) return std::nullopt;
  return GuardRule{Metric::ScaledJacobian, std::round(1e4 * (most_have - kRoom)) / 1e4};
}

std::vector<std::string> follow_recipe(const Recipe& recipe, const InputMesh& input, RunParameters& parameters,
                                       std::optional<double> said_gap) {
  std::vector<std::string> sentences;
  parameters.method = recipe.method;
  parameters.combination.reset();
  const bool usual_metric = parameters.metric == RunParameters{}.metric;
  if (recipe.raises_scaled_jacobian && usual_metric)
    parameters.combination = CompositeTerms{mean_ratio_to_reach(input), Metric::ScaledJacobian};
  parameters.joint_gap = said_gap.value_or(recipe.joint_gap);
  set_then(parameters, recipe.then, {});
  if (const std::string why_not = parameters.then_joint ? why_not_joint(input, {parameters.metric, parameters.combination}) : "";
      !why_not.empty()) {
    parameters.then_joint.reset();
    sentences.push_back(fmt::format("the recipe \"{}\" goes without joint moves: {}", recipe.name, why_not));
  }
  const auto guard = usual_metric ? guard_of_long_boxes(input) : std::nullopt;
  if (guard && parameters.guard == guard) parameters.guard = GuardRule{};  // of another recipe before this one
  if (!guard || !parameters.then_mean || parameters.combination || parameters.guard != GuardRule{}) return sentences;
  if (parameters.backend == Backend::Cuda) {
    sentences.push_back(
        fmt::format("the recipe \"{}\" goes without the guard of right angles, which is kept on the CPU alone", recipe.name));
    return sentences;
  }
  parameters.guard = guard;
  sentences.push_back(
      fmt::format("the elements are long boxes, so the recipe \"{}\" keeps their right angles by the guard {} (guard off lets "
                  "them lean)",
                  recipe.name, to_text(guard)));
  return sentences;
}

}  // namespace dmoscope
