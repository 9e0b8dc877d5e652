// dmoscope bench: measures how fast this machine smooths, against the plain search in double.

#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/common/console.h"
#include "app/common/option_checks.h"
#include "app/common/output_checks.h"
#include "app/common/text.h"
#include "app/pictures/pictures.h"
#include "app/subcommands/bench_measure.h"
#include "app/subcommands/bench_pictures.h"
#include "app/subcommands/bench_plan.h"
#include "app/subcommands/bench_report.h"
#include "app/subcommands/subcommands.h"

namespace dmoscope::app {
namespace {

constexpr std::uint64_t kMostRepeats = 1000;
constexpr std::uint64_t kMostTimed = 100'000;

int bench(const BenchOptions& options) {
  const BenchPlan plan = plan_of(options);
  if (!options.plot.empty()) require_plot_target(options.plot);
  require_another_file(options.plot, "--plot", options.file);
  Watch watch;
  if (options.draw > 0) {
    bench_drawing(plan, options.file, options.draw, options.json, watch.progress());
    return 0;
  }
  if (options.seek > 0) {
    bench_seeking(plan, options.file, options.seek, options.json, watch.progress());
    return 0;
  }
  if (options.window) {
    bench_window(plan, options.file, options.json, watch.progress());
    return 0;
  }
  std::vector<Measurement> figures;
  measure(plan, options.file, watch.progress(), [&](const std::vector<Measurement>& more) {
    if (!options.json) {
      if (figures.empty()) print_head(plan);
      print_rows(more);
    }
    figures.insert(figures.end(), more.begin(), more.end());
  });
  if (options.json) print_json(json_of(plan, figures));
  if (!options.plot.empty()) write_plot(options.plot, draw(plot_of(figures)));
  return 0;
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* subcommand = app.add_subcommand("bench", "Measure how fast this machine smooths, against the plain search in double");
  auto* file = subcommand->add_option("FILE", options->file, "Mesh to smooth instead of generated ones; its interfaces move, too");
  const auto list = [subcommand](const char* option, std::string& value, const char* type, const std::string& doc) {
    return subcommand->add_option(option, value, doc)->type_name(type)->capture_default_str();
  };
  list("--sizes", options->sizes, "N,N,...", "Vertices of the generated meshes")->excludes(file);
  subcommand->add_flag("--full", options->full, "Also a mesh of ten million vertices; takes some 4 GB of memory")->excludes(file);
  list("--elements", options->elements, "NAME,NAME,...", "Of the generated meshes: all, or some of " + names_of(bench_elements()))
      ->excludes(file);
  auto* metric = list("--metric", options->metric, "NAME,NAME,...", "Metrics to optimise: all, or some of " + names_of(metric_table()));
  auto* combine =
      subcommand->add_option("--combine", options->combine, "Two aims instead, in volumes two metrics; see dmoscope smooth --help");
  combine->type_name("FIRST:THRESHOLD:SECOND")->excludes(metric);
  list("--threads", options->threads, "N,N,...", "Numbers of threads; 0 uses every processor thread");
  list("--simd", options->simd, "LEVEL,LEVEL,...", "Vector instructions: all, or some of auto, baseline, avx2, avx512");
  list("--backend", options->backend, "NAME,NAME,...", "Backends: cpu, cuda, or auto: cpu, and cuda where it can be used");
  const auto count = [subcommand](const char* option, auto& value, std::uint64_t least, std::uint64_t most, const char* doc) {
    return subcommand->add_option(option, value, doc)->transform(whole_number(least, most))->type_name("N");
  };
  count("--repeats", options->repeats, 1, kMostRepeats, "Repeats of every measurement, in turn with the others")->capture_default_str();
  count("--iterations", options->iterations, 1, kMostTimed, "Iterations to time, from the input on")->capture_default_str();
  auto* active = count("--active", options->active, 2, kMostTimed, "Also compare the time of iteration N with that of the first");
  auto* end_to_end = subcommand->add_flag(
      "--end-to-end", options->end_to_end,
      "Also show the time from the mesh in memory to the smoothed one there: preparation, copies, iterations with statistics");
  end_to_end->excludes(active);
  auto* draw = count("--draw", options->draw, 1, kMostTimed, "Draw this many iterations as they are made, without a window, instead");
  auto* plot = subcommand->add_option("--plot", options->plot, "Draw visits per second over sizes")->type_name("FILE.svg|.png");
  draw->excludes(plot)->excludes(combine)->excludes(end_to_end);
  auto* seek = count("--seek", options->seek, 1, kMostTimed, "Number of seeks among 200 iterations, without and with drawing, instead");
  seek->excludes(plot)->excludes(draw)->excludes(combine)->excludes(end_to_end);
  subcommand->add_flag("--window", options->window, "Open the first mesh in the window, off screen: time, memory, answers; instead")
      ->excludes(plot)
      ->excludes(draw)
      ->excludes(seek)
      ->excludes(combine)
      ->excludes(end_to_end);
  add_memory_option(*subcommand, options->memory);
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  subcommand->callback([options, &action] {
    action = [options] { return within_memory(options->memory, options->file, [options] { return bench(*options); }); };
  });
}

}  // namespace dmoscope::app
