#include "library/run_options.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/thread_count.h"
#include "core/base/unknown_value.h"
#include "core/base/words.h"
#include "core/mesh/vertex_words.h"
#include "core/run/recipe.h"
#include "core/run/sliding.h"
#include "core/smooth/composite_objective.h"
#include "core/target/target.h"

namespace dmo {

namespace {

using Words = std::map<std::string, std::string>;

/// Removes an option and returns its value; empty if it is not given.
std::string take(Words& words, const std::string& name) {
  const auto node = words.extract(name);
  return node.empty() ? std::string() : node.mapped();
}

template <class Work>
auto naming(const std::string& option, const Work& work) {
  try {
    return work();
  } catch (const dmoscope::UsageError& error) {
    throw dmoscope::UsageError(fmt::format("{}: {}", option, error.what()));
  }
}

[[noreturn]] void refuse_unknown(const std::string& name) {
  std::vector<std::string_view> known{"combine", "fix",           "max-iterations", "method", "metric", "patience",
                                      "recipe",  "size-function", "slide",          "target", "then"};
  for (const dmoscope::ParameterInfo& row : dmoscope::parameter_table()) known.push_back(row.name);
  std::sort(known.begin(), known.end());
  throw dmoscope::UsageError(dmoscope::unknown_value("option", name, known));
}

void set_objective(dmoscope::RunParameters& parameters, Words& words) {
  const std::string metric = take(words, "metric"), combination = take(words, "combine"), size = take(words, "size-function");
  if (!metric.empty() && !combination.empty())
    throw dmoscope::UsageError("metric and combine: only one of them, combine names both metrics");
  if (combination.empty() && !size.empty()) throw dmoscope::UsageError("size-function is for combine with density");
  if (!metric.empty()) parameters.metric = naming("metric", [&] { return dmoscope::parse_metric(metric); });
  if (!combination.empty())
    std::tie(parameters.metric, parameters.combination) = naming("combine", [&] { return dmoscope::parse_composite(combination, size); });
  if (const std::string target = take(words, "target"); !target.empty())
    naming("target", [&] { aim_at(parameters, dmoscope::parse_target(target)); });
}

/// Throws UsageError for options that exclude each other, by the rules of the program.
void refuse_together(const Words& words, bool until_converged) {
  const auto said = [&words](const char* name) { return words.count(name) > 0; };
  for (const char* other : {"method", "combine", "then"})
    if (said("recipe") && said(other)) throw dmoscope::UsageError(fmt::format("recipe and {}: only one of them", other));
  for (const char* limit : {"patience", "max-iterations"})
    if (said(limit) && !until_converged) throw dmoscope::UsageError(fmt::format("{} is for until_converged", limit));
}

}  // namespace

RunRequest request_of(const dmoscope::InputMesh& input, const SmoothOptions& options) {
  RunRequest request;
  dmoscope::RunParameters& parameters = request.parameters;
  Words words = options.options;
  const bool said_gap = words.count("joint-gap") > 0;
  dmoscope::require_thread_count(options.threads);
  request.until_converged = options.until_converged || (words.count("recipe") > 0 && !options.iterations);
  refuse_together(words, request.until_converged);
  if (const std::string method = take(words, "method"); !method.empty()) {
    static_cast<void>(dmoscope::method_info(method));
    parameters.method = method;
  }
  set_objective(parameters, words);
  for (const dmoscope::ParameterInfo& row : dmoscope::parameter_table())
    if (const auto node = words.extract(std::string(row.name)); !node.empty())
      naming(node.key(), [&] { row.from_text(parameters, node.mapped()); });
  if (const std::string then = take(words, "then"); !then.empty()) naming("then", [&] { set_then(parameters, then, {}); });
  if (const std::string slide = take(words, "slide"); !slide.empty())
    naming("slide", [&] { slide_only(parameters, input, dmoscope::vertices_named(input.mesh, slide)); });
  if (const std::string fix = take(words, "fix"); !fix.empty())
    for (const Index v : naming("fix", [&] { return dmoscope::vertices_named(input.mesh, fix); })) parameters.fixed.push_back(v);
  if (const std::string recipe = take(words, "recipe"); !recipe.empty()) {
    std::string without =
        follow_recipe(dmoscope::recipe(recipe), input, parameters, said_gap ? std::optional(parameters.joint_gap) : std::nullopt);
    if (!without.empty()) request.warnings.push_back(std::move(without));
  }
  if (const std::string patience = take(words, "patience"); !patience.empty())
    request.limits.patience = naming("patience", [&] { return dmoscope::to_count(patience); });
  if (const std::string most = take(words, "max-iterations"); !most.empty())
    request.limits.max_iterations = naming("max-iterations", [&] { return dmoscope::to_count(most); });
  if (!words.empty()) refuse_unknown(words.begin()->first);

  for (const Index vertex : options.fixed)
    if (vertex >= input.mesh.vertex_count())
      throw dmoscope::UsageError(fmt::format("fixed: there is no vertex {}, the mesh has {}", vertex, input.mesh.vertex_count()));
  parameters.fixed.insert(parameters.fixed.end(), options.fixed.begin(), options.fixed.end());
  std::sort(parameters.fixed.begin(), parameters.fixed.end());
  parameters.fixed.erase(std::unique(parameters.fixed.begin(), parameters.fixed.end()), parameters.fixed.end());
  validate(parameters.search);
  validate(parameters.options);
  if (request.until_converged) be_patient(parameters, request.limits.patience);
  return request;
}

}  // namespace dmo
