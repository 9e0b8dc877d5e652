// dmoscope smooth: reads a mesh, smooths it, writes it.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/acceleration.h"
#include "app/console.h"
#include "app/targets.h"
#include "app/text.h"
#include "app/verbs/aims_report.h"
#include "app/verbs/declared_floats.h"
#include "app/verbs/goal_options.h"
#include "app/verbs/input_report.h"
#include "app/verbs/run_options.h"
#include "app/verbs/verbs.h"
#include "core/io/mesh_io.h"
#include "core/io/source_file.h"
#include "core/search/simd.h"
#include "core/session/carry_on.h"
#include "core/session/csv.h"
#include "core/session/run.h"

namespace dmoscope::app {
namespace {

struct Options {
  std::filesystem::path input, output, stats;
  RunOptions run;
  GoalOptions goal;
  bool json = false;
};

std::string_view reason_name(StopReason reason) {
  switch (reason) {
    case StopReason::NothingMoved:
      return "nothing-moved";
    case StopReason::NoRise:
      return "no-rise";
    case StopReason::IterationLimit:
      return "iteration-limit";
  }
  return "unknown";
}

Json json_of(const Statistics& s) {
  return {{"minimum", json_number(s.minimum)},
          {"mean", json_number(s.mean)},
          {"movable_minimum", json_number(s.movable_minimum)},
          {"ceiling", json_number(s.ceiling)},
          {"inverted", s.inverted}};
}

/// What came of it, as both the person and --json are told.
struct Result {
  const Options& options;
  const Run& run;
  unsigned threads;
  Outcome outcome;
  double seconds;
  std::vector<std::string> warnings;

  [[nodiscard]] const IterationRecord& before() const { return run.history().records().front(); }
  [[nodiscard]] const IterationRecord& after() const { return run.history().records().back(); }
  [[nodiscard]] double visits_per_second() const {
    const auto visits = static_cast<double>(outcome.iterations * run.visits_per_iteration());
    return seconds > 0.0 ? visits / seconds : 0.0;
  }
};

bool on_cpu(const Run& run) { return run.backend() == name(Backend::Cpu); }

/// By packs: the grid search alone can do that.
bool in_packs(const RunParameters& p) { return method_info(p.method).searches_grid && p.search.precision == Precision::Float; }

/// What the search computed with; null on a device.
Json simd_name(const Run& run) {
  const RunParameters& p = run.parameters();
  if (!on_cpu(run)) return nullptr;
  return in_packs(p) ? name(p.search.simd.value_or(best_simd_level())) : "scalar";
}

Json json_of(const Result& r) {
  const RunParameters& p = r.run.parameters();
  const Mesh& mesh = r.run.input().mesh;
  Json object;
  object["input"] = r.options.input.string();
  object["output"] = r.options.output.string();
  object["vertices"] = mesh.vertex_count();
  object["elements"] = mesh.elements.size();
  object["free"] = r.run.visits_per_iteration();
  object["method"] = p.method;
  object["metric"] = info(p.metric).name;
  object["backend"] = r.run.backend();
  object["backend_reason"] = r.run.backend_reason();
  object["threads"] = r.threads;
  object["simd"] = simd_name(r.run);
  object["parameters"] = {{"grid", p.search.grid_points},
                          {"levels", p.search.levels},
                          {"omega", p.search.omega},
                          {"precision", in_packs(p) && !p.combination ? "float" : "double"},
                          {"relaxation", p.options.relaxation},
                          {"directions", name(p.options.directions)},
                          {"seed", p.options.seed},
                          {"order", r.options.run.order},
                          {"fixed_by_user", p.fixed.size()}};
  object["iterations"] = r.outcome.iterations;
  object["stopped"] = reason_name(r.outcome.reason);
  object["last_rise"] = r.outcome.last_rise;
  object["before"] = json_of(r.before().statistics);
  object["after"] = json_of(r.after().statistics);
  add_aims(object, r.run);
  object["seconds"] = r.seconds;
  object["vertices_per_second"] = json_number(r.visits_per_second());
  object["warnings"] = r.warnings;
  return object;
}

void print_summary(const Result& r) {
  const Statistics& before = r.before().statistics;
  const Statistics& after = r.after().statistics;
  const Mesh& mesh = r.run.input().mesh;
  fmt::print("{}: {}, {}, {} free; {}, {}\n", mesh.name, counted(mesh.vertex_count(), "vertex", "vertices"),
             counted(mesh.elements.size(), "element", "elements"), grouped(r.run.visits_per_iteration()), r.run.title(), r.run.backend());
  fmt::print("  {:<16} {:>10} -> {}\n", "minimum", brief(before.minimum), brief(after.minimum));
  fmt::print("  {:<16} {:>10} -> {}\n", "movable minimum", brief(before.movable_minimum), brief(after.movable_minimum));
  fmt::print("  {:<16} {:>10}    (elements whose corners are all fixed)\n", "ceiling", brief(after.ceiling));
  fmt::print("  {:<16} {:>10} -> {}\n", "mean", brief(before.mean), brief(after.mean));
  fmt::print("  {:<16} {:>10} -> {}\n", "inverted", grouped(before.inverted), grouped(after.inverted));
  print_aims(r.run);
  fmt::print("  {}\n", r.outcome.sentence());
  fmt::print("  {} in {:.3f} s, {}vertices/s on {}\n", counted(r.outcome.iterations, "iteration", "iterations"), r.seconds,
             with_prefix(r.visits_per_second()), on_cpu(r.run) ? counted(r.threads, "thread", "threads") : r.run.backend_reason());
  fmt::print("  wrote {}\n", r.options.output.string());
}

/// Everything that can be refused without reading the mesh.
void refuse_early(const Options& options) {
  require_mesh_target(options.output, options.input);
  require_another_file(options.stats, "--stats", options.input);
  require_another_file(options.stats, "--stats", options.output);
  if (!options.stats.empty()) require_writable(options.stats);
}

void write_statistics(const std::filesystem::path& path, const Run& run) {
  const std::vector<std::string> titles{stats_label(run.parameters())};
  const std::vector<const std::vector<IterationRecord>*> records{&run.history().records()};
  write_file_atomically(path, stats_csv(titles, records));
}

double smoothing_seconds(const Run& run) {
  double seconds = 0.0;
  for (const IterationRecord& record : run.history().records()) seconds += record.seconds;
  return seconds;
}

bool keeps_the_format(const Options& options, const Mesh& mesh) {
  const FormatInfo* format = format_by_extension(mesh_extension(options.output));
  return mesh.source && format != nullptr && format->name == mesh.source->format();
}

int smooth(const Options& options) {
  refuse_early(options);
  RunParameters parameters = parameters_of(options.run);
  const Acceleration acceleration = acceleration_for(parameters.backend);

  Watch watch;
  Progress& progress = watch.progress();
  const auto pool = std::make_shared<ThreadPool>(options.run.threads);
  const auto input = load_input(options.input, Need::Smoothing, {progress, pool.get()});
  std::vector<std::string> warnings = tell_findings(*input);
  parameters.fixed = named_vertices(input->mesh, options.run.fix);

  Run run(input, std::move(parameters), pool, 0, acceleration);  // no past positions: nobody asks for them here
  const auto warn = [&warnings](std::string sentence) {
    complain(sentence);
    warnings.push_back(std::move(sentence));
  };
  if (std::string warning = run.take_warning(); !warning.empty()) warn(std::move(warning));
  if (run.size_field() && !run.size_field()->note().empty()) warn(run.size_field()->note());
  const auto smooth_all = [&] {  // from the input on: without history nothing else is left after a failure
    const Outcome done =
        options.goal.until_converged ? run.until_converged(options.goal.limits, progress) : run.iterate(options.goal.iterations, progress);
    run.settle();
    return done;
  };
  const Outcome outcome = carrying_on(run, smooth_all, warn);

  for (std::string& sentence : write_mesh(options.output, input->mesh, run.positions(), {progress, pool.get()})) {
    complain(fmt::format("{}: {}", options.output.string(), sentence));
    warnings.push_back(std::move(sentence));
  }
  if (keeps_the_format(options, input->mesh)) {
    const std::string seen = seen_as_floats(*input, run.positions(), run.parameters().metric, pool.get());
    if (!seen.empty()) warn(fmt::format("{}: {}", options.output.string(), seen));
  }
  if (!options.stats.empty()) write_statistics(options.stats, run);

  const Result result{options, run, pool->size(), outcome, smoothing_seconds(run), std::move(warnings)};
  if (options.json) {
    print_json(json_of(result));
  } else {
    print_summary(result);
  }
  const bool reached = !options.goal.until_converged || outcome.reason != StopReason::IterationLimit;
  if (!reached) complain(fmt::format("not converged: {}", outcome.sentence()));
  return reached ? 0 : 1;
}

}  // namespace

void add_smooth(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("smooth", "Smooth a mesh and write it");
  verb->add_option("IN", options->input, "Mesh to read")->required();
  verb->add_option("-o,--output", options->output, "Where to write it; the format is the extension's")->required()->type_name("OUT");
  add_run_options(*verb, options->run);
  add_goal_options(*verb, options->goal);
  verb->add_option("--stats", options->stats, "Write the statistics of every iteration; row 0 is the input")->type_name("FILE.csv");
  verb->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  verb->callback([options, &action] { action = [options] { return smooth(*options); }; });
}

}  // namespace dmoscope::app
