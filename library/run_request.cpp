#include "library/run_request.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/thread_count.h"
#include "core/quality/defined_metric.h"
#include "core/reference/slide_on.h"
#include "core/run/recipe.h"
#include "core/run/selections.h"
#include "library/mesh_data.h"

namespace dmo {

using dmoscope::InputMesh;
using dmoscope::RunParameters;

std::vector<std::string_view> method_words() {
  std::vector<std::string_view> words;
  for (const dmoscope::MethodInfo& method : dmoscope::method_table()) words.push_back(method.name);
  return words;
}

std::vector<std::string_view> recipe_words() {
  std::vector<std::string_view> words{"none"};
  for (const dmoscope::Recipe& recipe : dmoscope::recipe_table()) words.push_back(recipe.name);
  return words;
}

namespace {

void require_range(const char* option, std::uint64_t value, std::uint64_t least) {
  constexpr std::uint64_t kMost = 1'000'000'000;
  if (value < least || value > kMost)
    throw dmoscope::UsageError(fmt::format("{}: expected a whole number from {} to {}, not '{}'", option, least, kMost, value));
}

/// Throws UsageError for options that exclude each other, by the rules of the program.
void refuse_together(const SmoothOptions& options, bool until_converged) {
  const auto only_one = [](bool both, const char* names) {
    if (both) throw dmoscope::UsageError(fmt::format("{}: only one of them", names));
  };
  const bool recipe = options.recipe != Recipe::None;
  only_one(options.iterations && options.until_converged, "iterations and until_converged");
  only_one(recipe && options.method != Method::Dmo, "recipe and method");
  only_one(recipe && options.combine, "recipe and combine");
  only_one(recipe && (options.then_joint || options.then_mean), "recipe and then");
  const SmoothOptions usual;
  if (options.patience != usual.patience && !until_converged) throw dmoscope::UsageError("patience is for until_converged");
  if (options.max_iterations != usual.max_iterations && !until_converged)
    throw dmoscope::UsageError("max_iterations is for until_converged");
  if (!options.size_function.empty() && !options.combine) throw dmoscope::UsageError("size_function is for combine with density");
}

void set_objective(RunParameters& parameters, const SmoothOptions& options) {
  parameters.metric = naming("metric", [&] { return dmoscope::parse_metric(options.metric); });
  if (const auto& second = options.combine)
    std::tie(parameters.metric, parameters.combination) = naming("combine", [&] {
      return dmoscope::parse_composite(fmt::format("{}:{}:{}", options.metric, second->threshold, second->metric), options.size_function);
    });
  if (!options.target.empty()) naming("target", [&] { aim_at(parameters, dmoscope::parse_target(options.target)); });
}

void set_phases(RunParameters& parameters, const SmoothOptions& options) {
  const auto begin = [](bool comes) { return comes ? std::optional(dmoscope::PhaseBegin{}) : std::nullopt; };
  parameters.then_joint = begin(options.then_joint);
  parameters.then_mean = begin(options.then_mean.has_value());
  if (!options.then_mean) return;
  if (static_cast<std::size_t>(*options.then_mean) >= dmoscope::kMeanKinds.size())
    throw dmoscope::UsageError("then_mean: there is no such mean");
  parameters.mean = dmoscope::kMeanKinds[static_cast<std::size_t>(*options.then_mean)];
}

/// Parameters but for those that need the mesh.
RunParameters parameters_of(const SmoothOptions& options) {
  RunParameters parameters;
  parameters.method = word_of("method", options.method, method_words());
  set_objective(parameters, options);
  set_parameters(parameters, options);
  set_phases(parameters, options);
  validate(parameters.search);
  validate(parameters.options);
  return parameters;
}

dmoscope::Selections selections_of(const SmoothOptions& options) {
  dmoscope::Selections all;
  const auto take = [](auto& to, const char* option, const auto& names, const auto& numbers) {
    to.option = option;
    to.words = names;
    if constexpr (requires { to.numbers; })
      to.numbers = numbers;
    else
      to.ends = numbers;
  };
  take(all.fix, "fixed:", options.fixed.names, options.fixed.numbers);
  take(all.slide, "slide:", options.slide.names, options.slide.numbers);
  take(all.corner, "corners:", options.corners.names, options.corners.numbers);
  take(all.no_corner, "no_corners:", options.no_corners.names, options.no_corners.numbers);
  take(all.feature, "features:", options.features.names, options.features.ends);
  take(all.no_feature, "no_features:", options.no_features.names, options.no_features.ends);
  return all;
}

/// The mesh as it is judged; on another surface all cells of both count, as in the program.
std::shared_ptr<const InputMesh> input_of(const Mesh& mesh, const SmoothOptions& options, dmoscope::Progress& progress) {
  if (!options.surface) return mesh.data()->judged(progress);
  const Mesh whole = mesh.thin() ? mesh.with_thin(false) : mesh;
  const auto input = whole.data()->judged(progress);
  return naming("surface", [&] { return slide_on(*input, options.surface->data()->prepared(progress)); });
}

}  // namespace

RunRequest request_of(const Mesh& mesh, const SmoothOptions& options, dmoscope::Progress& progress) {
  RunRequest request;
  dmoscope::require_thread_count(options.threads);
  require_range("iterations", options.iterations.value_or(0), 0);
  require_range("patience", options.patience, 1);
  require_range("max_iterations", options.max_iterations, 0);
  request.until_converged = options.until_converged || (options.recipe != Recipe::None && !options.iterations);
  request.limits.patience = options.patience;
  request.limits.max_iterations = options.max_iterations;
  refuse_together(options, request.until_converged);
  RunParameters& parameters = request.parameters;
  parameters = parameters_of(options);
  const std::string_view recipe = word_of("recipe", options.recipe, recipe_words());
  if (parameters.fit > 0.0 && !options.surface) throw dmoscope::UsageError("fit: it takes a surface, to which vertices are drawn");

  request.input = input_of(mesh, options, progress);
  const InputMesh& input = *request.input;
  const dmoscope::Selections selections = selections_of(options);
  fix_and_slide(parameters, input, selections);
  std::ranges::sort(parameters.fixed);
  parameters.fixed.erase(std::unique(parameters.fixed.begin(), parameters.fixed.end()), parameters.fixed.end());
  naming("fields", [&] { require_fields(parameters.fields, input.mesh); });
  parameters.kinds = kinds_of(input, parameters, selections, request.warnings);
  if (options.recipe != Recipe::None) {
    const auto said_gap = options.joint_gap != RunParameters{}.joint_gap ? std::optional(options.joint_gap) : std::nullopt;
    for (std::string& sentence : follow_recipe(dmoscope::recipe(recipe), input, parameters, said_gap))
      request.warnings.push_back(std::move(sentence));
  }
  if (request.until_converged) be_patient(parameters, request.limits.patience);
  return request;
}

}  // namespace dmo
