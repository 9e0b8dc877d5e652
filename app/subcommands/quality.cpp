// dmoscope quality: judges a mesh without changing it.

#include "core/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/memory_limit.h"
#include "app/common/option_checks.h"
#include "app/common/output_checks.h"
#include "app/common/quality_report.h"
#include "app/common/shared_options.h"
#include "app/common/text.h"
#include "app/subcommands/input_report.h"
#include "app/subcommands/subcommands.h"
#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/inspect/element_fit.h"
#include "core/io/writing/atomic_file.h"
#include "core/reference/domain.h"
#include "core/run/parameters.h"
#include "core/session/csv.h"

namespace dmoscope::app {
namespace {

struct QualityOptions {
  std::filesystem::path input, surface, elements;
  std::string metric = "all";
  std::string target;  // see parse_target(); empty: ideal elements
  std::size_t worst = 0;
  MemoryLimit memory;
  ReadingOptions reading;
  bool json = false;
};

/// One metric over all elements of the mesh.
struct Column {
  Metric metric;
  std::vector<double> values;    // one per element, NaN if not defined
  std::vector<Index> ascending;  // elements with a value, worst first, the lowest index first among equals
  double mean = 0.0;
  std::size_t unacceptable = 0;

  [[nodiscard]] bool defined() const noexcept { return !ascending.empty(); }
  /// Nearest-rank percentile of the defined values.
  [[nodiscard]] double percentile(double p) const {
    const auto rank = static_cast<std::size_t>(std::ceil(p / 100.0 * static_cast<double>(ascending.size())));
    return values[ascending[std::max<std::size_t>(rank, 1) - 1]];
  }
};

Column judge(const InputMesh& input, Metric metric, ThreadPool& pool) {
  Column column{metric, std::vector<double>(input.mesh.elements.size()), {}};
  element_qualities(input.quality_context(), input.mesh.positions, metric, &pool, column.values);
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const double q = column.values[e];
    if (std::isnan(q)) continue;
    column.ascending.push_back(e);
    if (q < info(metric).acceptable) ++column.unacceptable;
  }
  std::stable_sort(column.ascending.begin(), column.ascending.end(),
                   [&column](Index a, Index b) { return column.values[a] < column.values[b]; });
  if (column.defined())  // added up in the order of all statistics, so that a mesh has one mean
    column.mean = compute_statistics(input.quality_context(), input.mesh.positions, metric, std::span<const Index>(), &pool).mean;
  return column;
}

std::vector<Metric> wanted_metrics(const std::string& name, const std::string& target) {
  std::vector<Metric> metrics;
  if (name != "all")
    metrics.push_back(parse_metric(name));
  else if (target.empty())
    for (const MetricInfo& metric : metric_table()) metrics.push_back(metric.metric);
  else
    metrics = {Metric::MeanRatio, parse_metric("relative-size"), parse_metric("shape-size"), parse_metric("aspect")};  // for every element
  if (!target.empty())
    for (Metric& metric : metrics) metric = with_target(metric, parse_target(target));
  return metrics;
}

std::vector<Index> worst_of(const Column& column, std::size_t count) {
  const auto end = column.ascending.begin() + static_cast<std::ptrdiff_t>(std::min(count, column.ascending.size()));
  return {column.ascending.begin(), end};
}

MetricSummary summary_of(const InputMesh& input, const Column& column, std::size_t worst) {
  MetricSummary summary{.metric = column.metric, .elements = column.ascending.size()};
  if (!column.defined()) return summary;
  summary.minimum = column.percentile(0);
  summary.percentile_1 = column.percentile(1);
  summary.percentile_5 = column.percentile(5);
  summary.percentile_50 = column.percentile(50);
  summary.mean = column.mean;
  summary.unacceptable = column.unacceptable;
  for (const Index e : worst_of(column, worst))
    summary.worst.push_back({e, input.mesh.elements.kind(e), column.values[e],
                             in_file(input.mesh, centroid(input.quality_context(), input.mesh.positions, e))});
  return summary;
}

/// Distance of the mesh from the surface that it is to slide on.
struct Nearness {
  double deviation = 0.0;       // greatest, in mesh units
  double tilt = 0.0;            // greatest, in degrees
  std::size_t not_over_it = 0;  // elements with a face that is not above the surface
};

Nearness nearness_of(const InputMesh& input, ThreadPool& pool) {
  const Domain domain(input, {InterfaceRule::Slide, BoundaryRule::Slide});
  const ElementFit fit = element_fit(input, domain, input.mesh.positions, &pool);
  std::vector<std::uint8_t> has_face(input.mesh.elements.size(), input.is_surface() ? 1 : 0);
  for (const ElementFace& face : input.faces.boundary()) has_face[face.element] = 1;
  Nearness near;
  for (Index e = 0; e < has_face.size(); ++e) {
    if (std::isnan(fit.deviation[e])) {
      near.not_over_it += has_face[e];
      continue;
    }
    near.deviation = std::max(near.deviation, static_cast<double>(fit.deviation[e]));
    near.tilt = std::max(near.tilt, static_cast<double>(fit.tilt[e]));
  }
  return near;
}

int quality(const QualityOptions& options) {
  const std::vector<Metric> metrics = wanted_metrics(options.metric, options.target);
  if (!options.elements.empty()) require_writable(options.elements);
  require_another_file(options.elements, "--elements", options.input);
  if (!options.surface.empty()) require_another_file(options.elements, "--elements", options.surface);

  Watch watch;
  IoContext reading(watch.progress(), nullptr, options.memory.bytes());
  options.reading.tell(reading);
  const auto input = load_input_on(options.input, options.surface, Need::QualityOnly, reading);
  const Mesh& mesh = input->mesh;
  std::vector<std::string> warnings = tell_findings(*input);
  for (const Metric metric : metrics)
    if (!is_built_in(metric)) require_defined(metric, *input);
  ThreadPool pool;
  std::vector<Column> columns;
  for (const Metric metric : metrics) {
    watch.progress().check();
    columns.push_back(judge(*input, metric, pool));
  }
  if (options.metric != "all" && !columns.front().defined() && mesh.elements.size() > 0) {
    throw UsageError(fmt::format("{} is defined for no element of {}", options.metric, mesh.name));
  }
  if (!options.elements.empty()) write_file_atomically(options.elements, elements_csv(input->quality_context(), mesh.positions, metrics));
  std::vector<MetricSummary> summaries;
  for (const Column& column : columns) summaries.push_back(summary_of(*input, column, options.worst));
  const InvertedCount inverted = count_inverted(input->quality_context(), mesh.positions);
  const auto near = input->surface ? std::optional(nearness_of(*input, pool)) : std::nullopt;
  const double share = near ? near->deviation / input->geometry.size : 0.0;
  if (options.json) {
    Json list = Json::array();
    for (const MetricSummary& summary : summaries) list.push_back(json_of(summary, options.worst > 0));
    Json object{{"input", options.input.string()},
                {"vertices", mesh.vertex_count()},
                {"elements", mesh.elements.size()},
                {"inverted", inverted.all},
                {"inverted_inside_alone", inverted.inside_alone},
                {"inverted_elements", json_of_inverted(inverted)},
                {"metrics", std::move(list)},
                {"groups", json_of_groups(mesh)},
                {"warnings", warnings}};
    if (near)
      object["surface"] = {{"file", options.surface.string()},
                           {"deviation", near->deviation},
                           {"share_of_size", share},
                           {"distance", app::json_of(surface_distance(*input, mesh.positions))},
                           {"tilt", near->tilt},
                           {"not_over_it", near->not_over_it}};
    print_json(object);
    return 0;
  }
  print_counts(mesh.name, mesh.vertex_count(), mesh.elements.size(), inverted);
  if (near)
    print("on {}: at most {:.3g} away ({:.2g} of the mesh's size), tilted by at most {:.1f} degrees; {} not over it\n\n",
          input->surface->mesh.name, near->deviation, share, near->tilt, counted(near->not_over_it, "element lies", "elements lie"));
  if (!target_of(metrics.front()).is_ideal()) print("{}\n\n", target_sentence(*input, metrics.front()));
  print_summaries(summaries, input->geometry);
  constexpr std::size_t kMostGroups = 20;
  print_groups(mesh, kMostGroups);
  return 0;
}

}  // namespace

void add_quality(CLI::App& app, Action& action) {
  auto options = std::make_shared<QualityOptions>();
  CLI::App* subcommand = app.add_subcommand("quality", "Judge the elements of a mesh");
  subcommand->add_option("FILE", options->input, "Mesh to read")->required();
  subcommand->add_option("--metric", options->metric, "all, or one of " + names_of_metrics())->type_name("NAME|all")->capture_default_str();
  subcommand->add_option("--target", options->target, fmt::format("What elements are wished to be instead of ideal: {}", kTargetHelp))
      ->type_name("SHAPE");
  subcommand->add_option("--worst", options->worst, "List the N worst elements of each metric")
      ->transform(whole_number(0, kNoIndex))
      ->type_name("N");
  subcommand->add_option("--elements", options->elements, "Write the quality of every element; empty where a metric is not defined")
      ->type_name("FILE.csv");
  add_surface_option(*subcommand, options->surface);
  add_memory_option(*subcommand, options->memory);
  add_reading_options(*subcommand, options->reading);
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  subcommand->callback([options, &action] {
    action = [options] { return within_memory(options->memory, options->input, [options] { return quality(*options); }); };
  });
}

}  // namespace dmoscope::app
