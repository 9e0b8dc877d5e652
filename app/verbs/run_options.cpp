#include "app/verbs/run_options.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/text.h"
#include "app/verbs/option_checks.h"
#include "core/base/error.h"
#include "core/mesh/vertex_words.h"
#include "core/quality/metric.h"
#include "core/session/session_commands.h"

namespace dmoscope::app {
namespace {

void require_method(const std::string& name) {
  const auto known = [&name](const MethodInfo& method) { return method.name == name; };
  if (std::none_of(method_table().begin(), method_table().end(), known)) {
    throw UsageError(fmt::format("unknown method '{}' (known: {})", name, names_of(method_table())));
  }
}

}  // namespace

void add_backend_option(CLI::App& verb, std::string& backend) {
  verb.add_option("--backend", backend, "What smooths: cpu, cuda, or auto: cuda where it can be used")
      ->type_name("NAME")
      ->capture_default_str();
}

void add_run_options(CLI::App& verb, RunOptions& options) {
  verb.add_option("--method", options.method, "Method: " + names_of(method_table()))->type_name("NAME")->capture_default_str();
  auto* metric = verb.add_option("--metric", options.metric, "Metric to optimise: " + names_of(metric_table()))->type_name("NAME");
  metric->capture_default_str();
  auto* combine = verb.add_option("--combine", options.combine,
                                  "Two aims: the metric FIRST up to THRESHOLD, and beyond it SECOND: another metric, or density, which "
                                  "adapts the sizes of elements");
  combine->type_name("FIRST:THRESHOLD:SECOND")->excludes(metric);
  verb.add_option("--size-function", options.size_function,
                  "Of --combine with density, the size that elements shall have: h1:X,Y (grows with the distance to a point), h2:X,Y "
                  "(falls with it), constant, or field:NAME (a nodal field of the file)")
      ->type_name("SIZE")
      ->needs(combine);
  verb.add_option("--then", options.then, "What follows once the minimum has converged: mean (raises the mean, with the minimum as floor)")
      ->type_name("mean")
      ->excludes(combine);
  add_backend_option(verb, options.backend);
  verb.add_option("--threads", options.threads, "Threads; 0: one a processor thread. The result is the same for any")
      ->transform(whole_number(0, kMostThreads))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--grid", options.search.grid_points, "Candidates an axis")
      ->transform(whole_number(2, 64))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--levels", options.search.levels, "Grids a visit, each finer than the one before")
      ->transform(whole_number(1, 16))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--omega", options.search.omega, "Size of the first grid over the bounding box of the star's other vertices")
      ->type_name("X")
      ->capture_default_str();
  verb.add_option("--precision", options.precision, "Scalar of the search, float or double; moves are always confirmed in double")
      ->type_name("NAME")
      ->capture_default_str();
  verb.add_option("--simd", options.simd, "Vector instructions: auto, baseline, avx2 or avx512. The result is the same for any")
      ->type_name("LEVEL")
      ->capture_default_str();
  verb.add_option("--relaxation", options.method_options.relaxation,
                  "laplace, smart-laplace, angle-based: the share of the way that is gone, above 0, up to 1")
      ->type_name("X")
      ->capture_default_str();
  verb.add_option("--directions", options.directions, "dvr: its lines' directions, random or axes")
      ->type_name("NAME")
      ->capture_default_str();
  verb.add_option("--seed", options.method_options.seed, "dvr: of its random directions")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--order", options.order, "Order of the vertices: natural or shuffle:SEED")->type_name("ORDER")->capture_default_str();
  verb.add_option("--fix", options.fix, fmt::format("Vertices to keep where they are besides the boundary: {}", kVertexWords))
      ->type_name("VERTICES")
      ->take_all()
      ->expected(1);
  verb.add_option("--interfaces", options.interfaces,
                  "What lies between groups of elements (or between values of material, region, mat_id and the like), on lines and faces "
                  "inside that the file names, on its boundary strings, and points that it names: fixed, or free to move")
      ->type_name("fixed|free")
      ->capture_default_str();
}

RunParameters parameters_of(const RunOptions& options) {
  RunParameters parameters;
  require_method(options.method);
  parameters.method = options.method;
  parameters.metric = parse_metric(options.metric);
  if (!options.combine.empty())
    std::tie(parameters.metric, parameters.combination) = parse_combination(options.combine, options.size_function);
  if (!options.then.empty()) {
    if (options.then != "mean") throw UsageError(fmt::format("--then knows 'mean' alone, not '{}'", options.then));
    parameters.then_mean.emplace();
  }
  validate(options.search);
  parameters.search = options.search;
  parameters.search.precision = parse_precision(options.precision);
  if (options.simd != "auto") parameters.search.simd = parse_simd_level(options.simd);
  parameters.options = options.method_options;
  parameters.options.directions = parse_directions(options.directions);
  validate(parameters.options);
  parameters.order = parse_order(options.order);
  parameters.interfaces = parse_interface_rule(options.interfaces);
  parameters.backend = parse_backend(options.backend);
  return parameters;
}

}  // namespace dmoscope::app
