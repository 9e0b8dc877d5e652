#include "app/common/run_options.h"

#include <limits>
#include <tuple>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/option_checks.h"
#include "app/common/text.h"
#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/base/words.h"
#include "core/mesh/vertex_words.h"
#include "core/quality/metric.h"
#include "core/reference/edge_words.h"
#include "core/run/recipe.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope::app {
namespace {

/// Makes a check that refuses words other than numbers.
CLI::Validator real_number() {
  return CLI::Validator(
      [](const std::string& word) {
        try {
          static_cast<void>(to_number(word));
          return std::string();
        } catch (const UsageError& error) {
          return std::string(error.what());
        }
      },
      "");
}

void add_parameter(CLI::App& subcommand, const ParameterInfo& row, std::string& value) {
  CLI::Option* option = subcommand.add_option(fmt::format("--{}", row.name), value, row.help())->type_name(std::string(row.type));
  option->capture_default_str();
  if (row.kind == ParameterKind::Whole) {
    constexpr double kAny = static_cast<double>(std::numeric_limits<std::uint64_t>::max());
    option->transform(whole_number(static_cast<std::uint64_t>(row.least),
                                   row.most < kAny ? static_cast<std::uint64_t>(row.most) : std::numeric_limits<std::uint64_t>::max()));
  }
  if (row.kind == ParameterKind::Real) option->check(real_number());
}

void add_selections(CLI::App& subcommand, Selections& selections) {
  const auto add = [&](auto& into, const char* type, const std::string& help) {
    subcommand.add_option(std::string(into.option), into.words, help)->type_name(type)->take_all()->expected(1);
  };
  add(selections.fix, "VERTICES", fmt::format("Vertices to keep where they are besides the boundary: {}", kVertexWords));
  add(selections.slide, "VERTICES",
      "Vertices of the boundary, named as those to fix are, that slide while the rest of the boundary stays: loop:1");
  add(selections.corner, "VERTICES", "Vertices that stay where others slide, named as those to fix are");
  add(selections.no_corner, "VERTICES", "Vertices that slide though their curve turns there by more than the corner angle");
  add(selections.feature, "EDGES",
      fmt::format("Feature edges, which nothing crosses and along which their vertices slide: {}", kEdgeWords));
  add(selections.no_feature, "EDGES", "Edges that are smooth though the surface folds there by more than the feature angle");
}

}  // namespace

std::map<std::string, std::string, std::less<>> usual_parameters() {
  std::map<std::string, std::string, std::less<>> values;
  for (const ParameterInfo& row : parameter_table()) values.emplace(row.name, row.to_text(RunParameters{}));
  return values;
}

void add_backend_option(CLI::App& subcommand, std::string& backend) {
  subcommand.add_option("--backend", backend, "What smooths: cpu, cuda, or auto: cuda where it can be used")
      ->type_name("NAME")
      ->capture_default_str();
}

void add_run_options(CLI::App& subcommand, RunOptions& options) {
  subcommand.add_option("--method", options.method, "Method: " + names_of(method_table()))->type_name("NAME")->capture_default_str();
  auto* metric = subcommand.add_option("--metric", options.metric, "Metric to optimise: " + names_of_metrics())->type_name("NAME");
  metric->capture_default_str();
  subcommand.add_option("--target", options.target, fmt::format("What elements are wished to be instead of ideal: {}", kTargetHelp))
      ->type_name("SHAPE");
  auto* combine =
      subcommand.add_option("--combine", options.combine,
                            "Two aims: the metric FIRST up to THRESHOLD, and beyond it SECOND: another metric, or density, which "
                            "adapts the sizes of elements");
  combine->type_name("FIRST:THRESHOLD:SECOND")->excludes(metric);
  subcommand
      .add_option("--size-function", options.size_function,
                  "Desired element size, for --combine with density: h1:X,Y (grows with the distance to a point), h2:X,Y "
                  "(falls with it), constant, or field:NAME (a nodal field of the file)")
      ->type_name("SIZE")
      ->needs(combine);
  subcommand
      .add_option(
          "--then", options.then,
          "After the minimum has converged: joint (joint moves, which raise the minimum further), mean (raise the harmonic mean without "
          "lowering the minimum; or arithmetic-mean, geometric-mean, inverse-square-mean), or both")
      ->type_name("mean|joint|joint,mean");
  std::string recipes = "Method and phases under one name:";
  for (const Recipe& one : recipe_table())
    recipes +=
        fmt::format("{} {} ({}{})", &one == recipe_table().data() ? "" : ";", one.name, one.doc, one.name == "best" ? "; recommended" : "");
  subcommand.add_option("--recipe", options.recipe, recipes)
      ->type_name("NAME")
      ->excludes(combine)
      ->excludes(subcommand.get_option("--then"))
      ->excludes(subcommand.get_option("--method"));
  subcommand.add_option("--threads", options.threads, "Number of threads; 0 uses every processor thread. The result does not depend on it")
      ->transform(whole_number(0, kMostThreads))
      ->type_name("N")
      ->capture_default_str();
  subcommand
      .add_option("--hints", options.hints,
                  "Whether it is looked, once a run is done, for what holds the minimum and what gets further: on (for a tenth of the "
                  "run's time, at least 0.2 s), full (as long as it takes) or off. The mesh is the same")
      ->type_name("on|full|off")
      ->capture_default_str();
  for (const ParameterInfo& row : parameter_table()) add_parameter(subcommand, row, options.parameters.at(std::string(row.name)));
  add_selections(subcommand, options.selections);
}

RunParameters parameters_of(const RunOptions& options) {
  RunParameters parameters;
  static_cast<void>(method_info(options.method));
  parameters.method = options.method;
  parameters.metric = parse_metric(options.metric);
  if (!options.combine.empty())
    std::tie(parameters.metric, parameters.combination) = parse_composite(options.combine, options.size_function);
  if (!options.target.empty()) aim_at(parameters, parse_target(options.target));
  if (!options.recipe.empty()) static_cast<void>(recipe(options.recipe));
  if (!options.then.empty()) {
    try {
      set_then(parameters, options.then, {});
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--then: {}", error.what()));
    }
  }
  for (const ParameterInfo& row : parameter_table()) row.from_text(parameters, options.parameters.at(std::string(row.name)));
  validate(parameters.search);
  validate(parameters.options);
  return parameters;
}

}  // namespace dmoscope::app
