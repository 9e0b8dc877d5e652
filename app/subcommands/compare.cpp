// dmoscope compare: several runs on one mesh, side by side.

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/option_checks.h"
#include "app/common/output_checks.h"
#include "app/common/provenance.h"
#include "app/common/shared_options.h"
#include "app/comparison/report.h"
#include "app/pictures/pictures.h"
#include "app/subcommands/input_report.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope::app {
namespace {

constexpr std::uint64_t kMostShuffles = 1000;

struct Target {
  std::string_view option;
  const std::filesystem::path& path;
};

std::vector<Target> targets_of(const CompareOptions& options) {
  std::vector<Target> targets;
  for (const Target& target : {Target{"--stats", options.stats}, Target{"--table", options.table}, Target{"--plot", options.plot},
                               Target{"--report", options.report}})
    if (!target.path.empty()) targets.push_back(target);
  return targets;
}

/// Checks all that needs no mesh. Throws UsageError and OutputError.
void refuse_early(const CompareOptions& options) {
  const std::vector<Target> targets = targets_of(options);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    require_another_file(targets[i].path, targets[i].option, options.file);
    if (!options.surface.empty()) require_another_file(targets[i].path, targets[i].option, options.surface);
    for (std::size_t k = 0; k < i; ++k) require_another_file(targets[i].path, targets[i].option, targets[k].path);
  }
  if (!options.plot.empty()) require_plot_target(options.plot);
  if (!options.report.empty() && options.report.extension() != ".html")
    throw UsageError(fmt::format("{}: reports are written as .html", options.report.string()));
  for (const Target& target : targets) require_writable(target.path);
}

void write_files(const Comparison& comparison, const ComparisonFacts& facts, const Progress& progress) {
  const CompareOptions& options = facts.options;
  const std::string report = options.report.empty() ? std::string() : html_of(comparison, facts, progress);  // this takes long
  AtomicFiles files;  // all are on the disk before the first is renamed
  if (!options.stats.empty()) files.add(options.stats, statistics_csv(comparison));
  if (!options.table.empty()) files.add(options.table, table_csv(comparison));
  if (!options.plot.empty()) {
    const Drawing courses = stacked(draw(convergence_plot(comparison)), draw(mean_plot(comparison)));
    files.add(options.plot, plot_bytes(options.plot, stacked(courses, draw(sorted_plot(comparison)))));
  }
  if (!options.report.empty()) files.add(options.report, report);
  files.commit();
}

int compare(const CompareOptions& options, const std::string& command_line) {
  refuse_early(options);
  const Hints hints = parse_hints(options.run.hints);
  ComparisonPlan plan = plan_of(options);
  if (options.goal.until_converged)  // the first phase has the same patience as alone
    for (Contender& contender : plan.contenders) be_patient(contender.parameters, options.goal.until_converged->patience);
  Watch watch;
  Progress& progress = watch.progress();
  const auto pool = std::make_shared<ThreadPool>(options.run.threads);
  IoContext reading(progress, pool.get(), options.memory.bytes());
  options.reading.tell(reading);
  const auto input = load_input_on(options.file, options.surface, Need::Smoothing, reading, options.materials);
  std::vector<std::string> warnings = tell_findings(*input);
  for (Contender& contender : plan.contenders) fix_and_slide(contender.parameters, *input, options.run.selections);
  fit_to_mesh(plan, input, tell_kinds(*input, plan.contenders.front().parameters, options.run.selections, warnings));
  tell_interfaces(*input, plan.contenders.front().parameters, warnings);

  const auto warn = [&warnings](std::string sentence) {
    complain(sentence);
    warnings.push_back(std::move(sentence));
  };
  const Comparison comparison = run_all(plan, input, options.goal, options.shuffles, {pool, plan.acceleration, progress, warn, hints});
  const ComparisonFacts facts{options, goal_sentence(options.goal), pool->size(), command_line, std::move(warnings)};
  write_files(comparison, facts, progress);
  if (options.json) {
    Json object = json_of(comparison, facts);
    object["provenance"] = json_of(provenance_of(input->mesh, command_line));
    print_json(object);
  } else {
    print_lines(text_of(comparison));
    for (const Target& target : targets_of(options)) print("wrote {}\n", target.path.string());
  }
  bool reached = true;
  for (const auto* runs : {&comparison.runs, &comparison.shuffled}) {
    for (const JudgedRun& run : *runs) {
      if (run.after.inverted > 0) {
        complain(fmt::format("{}: {} inverted at the end", run.name, counted(run.after.inverted, "element is", "elements are")));
        reached = false;
      }
      if (run.converged_or_done(options.goal)) continue;
      complain(fmt::format("{}: not converged: {}", run.name, run.outcome.sentence()));
      reached = false;
    }
  }
  return reached ? 0 : 1;
}

}  // namespace

void add_compare(CLI::App& app, Action& action, const std::string& command_line) {
  auto options = std::make_shared<CompareOptions>();
  auto goal = std::make_shared<GoalOptions>();
  CLI::App* subcommand = app.add_subcommand("compare", "Smooth a mesh by several methods or metrics, and compare");
  subcommand->add_option("FILE", options->file, "Mesh to read")->required();
  subcommand
      ->add_option("--run", options->runs,
                   "A run: METHOD[:METRIC[:BACKEND]], append ',alone' to ignore --combine and --then, or ',then mean' as by "
                   "--then; may be given again")
      ->type_name("SPEC")
      ->expected(1)
      ->take_all();
  subcommand
      ->add_option("--every", options->every, "method: a run by every method; metric: a run for every metric; what cannot be is left out")
      ->type_name("method|metric")
      ->expected(1)
      ->take_all();
  subcommand->add_option("--judge", options->judge, "Metric that all runs are judged by (the first run's unless given)")->type_name("NAME");
  subcommand->add_option("--shuffles", options->shuffles, "Do each run also in N shuffled orders, and say how far they lie apart")
      ->transform(whole_number(0, kMostShuffles))
      ->type_name("N");
  add_goal_options(*subcommand, *goal);
  add_run_options(*subcommand, options->run);
  add_surface_option(*subcommand, options->surface);
  add_materials_option(*subcommand, options->materials);
  subcommand->remove_option(subcommand->get_option("--method"));  // a SPEC has the method; --metric and --backend are its defaults
  subcommand->add_option("--stats", options->stats, "Write the statistics of every iteration of every run")->type_name("FILE.csv");
  subcommand->add_option("--table", options->table, "Write the table, with all columns")->type_name("FILE.csv");
  subcommand->add_option("--plot", options->plot, "Draw how minimum and mean go, and the sorted qualities")->type_name("FILE.svg|.png");
  subcommand->add_option("--report", options->report, "Write a page with tables, plots and pictures that needs nothing else")
      ->type_name("FILE.html");
  add_memory_option(*subcommand, options->memory);
  add_reading_options(*subcommand, options->reading);
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  subcommand->callback([options, goal, command_line = &command_line, &action] {
    options->goal = goal_of(*goal);
    action = [options, command_line] {
      return within_memory(options->memory, options->file, [&] { return compare(*options, *command_line); });
    };
  });
}

}  // namespace dmoscope::app
