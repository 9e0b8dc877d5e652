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

/// Guard of a mesh whose elements are nearly all boxes. The mean ratio of a long one rises where it leans, for that makes it shorter: its
/// right angles stay instead. None for other meshes.
std::optional<GuardRule> guard_of_boxes(const InputMesh& input) {
  constexpr double kBoxes = 0.87;   // a little above what triangles, tetrahedra and wedges can have
  constexpr double kRoom = 0.0025;  // half of what the report card lets a quality fall; without any, a box could not move
  const Percentiles now = compute_percentiles(input.quality_context(), input.mesh.positions, Metric::ScaledJacobian, nullptr);
  if (!(now.p1 >= kBoxes)) return std::nullopt;
  return GuardRule{Metric::ScaledJacobian, std::round(1e4 * (now.p5 - kRoom)) / 1e4};
}
}  // namespace

std::span<const Recipe> recipe_table() { return kRecipes; }

const Recipe& recipe(std::string_view name) {
  const auto found = std::ranges::find(kRecipes, name, &Recipe::name);
  if (found == kRecipes.end()) throw UsageError(unknown_row("recipe", name, kRecipes));
  return *found;
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
  const bool may_guard = usual_metric && !parameters.combination && parameters.guard == GuardRule{} && parameters.backend != Backend::Cuda;
  if (const auto guard = parameters.then_mean && may_guard && !input.share ? guard_of_boxes(input) : std::nullopt) {
    parameters.guard = guard;
    sentences.push_back(
        fmt::format("nearly all elements are boxes, so the recipe \"{}\" keeps their right angles: --guard {} (--guard off "
                    "lets them lean)",
                    recipe.name, to_text(guard)));
  }
  return sentences;
}

}  // namespace dmoscope
