// dmoscope smooth: reads a mesh, smooths it, writes it.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/acceleration.h"
#include "app/common/console.h"
#include "app/common/hints.h"
#include "app/common/memory_limit.h"
#include "app/common/output_checks.h"
#include "app/common/provenance.h"
#include "app/common/run_options.h"
#include "app/common/shared_options.h"
#include "app/common/smooth_report.h"
#include "app/common/text.h"
#include "app/subcommands/checkpoint.h"
#include "app/subcommands/input_report.h"
#include "app/subcommands/subcommands.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/reference/domain.h"
#include "core/run/crossing_faces.h"
#include "core/run/ending.h"
#include "core/run/hints.h"
#include "core/run/recipe.h"
#include "core/run/retry_on_cpu.h"
#include "core/run/trial.h"
#include "core/session/session.h"
#include "core/transfer/moved_fields.h"
#include "core/transfer/thin_places.h"

namespace dmoscope::app {
namespace {

struct SmoothOptions {
  std::filesystem::path input, surface, output, stats;
  std::vector<std::string> materials;
  RunOptions run;
  GoalOptions goal;
  std::string write = "best";
  CheckpointOptions checkpoints;
  MemoryLimit memory;
  ReadingOptions reading;
  bool json = false;
  bool provenance = false;
  bool strict = false;
  std::string command_line;
};

/// Checks all that needs no mesh. Throws UsageError and OutputError.
void refuse_early(const SmoothOptions& options) {
  require_output_moment(options.write);
  require_mesh_target(options.output, options.input);
  require_another_file(options.stats, "--stats", options.input);
  if (!options.surface.empty()) {
    require_another_file(options.output, "--output", options.surface);
    require_another_file(options.stats, "--stats", options.surface);
  }
  require_another_output(options.stats, "--stats", options.output);
  if (!options.stats.empty()) require_writable(options.stats);
  refuse_early(options.checkpoints, {options.input, options.output, options.stats});
}

/// Writes the mesh and the statistics: none is renamed before both are on the disk. Returns sentences about content that the mesh's format
/// cannot carry.
std::vector<std::string> write_results(const SmoothOptions& options, const Run& run, std::span<const Vec3> places,
                                       const MovedFields& fields, const std::optional<Provenance>& provenance, const IoContext& context) {
  AtomicFiles others;
  if (!options.stats.empty()) others.add(options.stats, stats_of(run));
  const std::string comment = options.provenance ? comment_of(*provenance) : std::string();
  std::vector<std::string> sentences = write_commented_mesh(options.output, run.input().mesh, {places, fields.values}, context, comment);
  others.commit();
  return sentences;
}

/// Throws UsageError if a resumed run is already beyond the goal's end.
void require_at_goal(const Run& run, const Outcome& outcome) {
  if (run.moment().iteration == outcome.iterations) return;
  throw UsageError(fmt::format("--resume: that run has come to iteration {} already, and what is asked for ends at {}",
                               run.moment().iteration, outcome.iterations));
}

/// Warns which method gets further if elements stay inverted, and returns the hold of the minimum.
template <class Warn>
std::optional<HeldMinimum> look_for_hints(const Run& run, bool inverted, Hints hints, double seconds,
                                          const std::shared_ptr<ThreadPool>& pool, Progress& progress, const Warn& warn) {
  const HintBudget budget = budget_of(hints, seconds), with_trial = trial_budget_of(hints, seconds);
  std::optional<HeldMinimum> held;
  const auto find_method = [&] {
    progress.begin("looking for a method that gets further");
    const UntanglingLook look = untangling_hint(run, pool, progress, [half = budget.half()] { return half.left(); });
    if (look.hint) warn(fmt::format("{}: try --method {}", look.hint->sentence(), look.hint->method));
    if (!look.to_the_end) warn("Whether another method gets further was not looked at to the end (--hints full does)");
  };
  const auto find_hold = [&] {
    progress.begin("looking for what holds the minimum");
    held = what_holds(run, pool.get(), progress, {.go_on = [&] { return budget.left(); }});
  };
  const auto find_trial = [&] {
    // Preparing a trial takes about as long as some iterations.
    const double iteration = seconds / static_cast<double>(std::max<std::uint64_t>(1, run.history().records().size() - 1));
    if (!held || !held->change || !with_trial.has(3 * iteration)) return;
    progress.begin("trying what would free the minimum");
    TrialBudget trial;
    trial.time_left = [&] { return with_trial.left(); };
    const auto now = run.positions();
    held->trial = try_switch(run, *held, {std::make_shared<const std::vector<Vec3>>(now.begin(), now.end())}, trial, pool, progress);
  };
  if (inverted) look_afterwards("whether another method gets further", find_method, warn);
  look_afterwards("what holds the minimum", find_hold, warn);
  look_afterwards("what would free the minimum", find_trial, warn);
  return held;
}

/// Distances from the surface to which vertices were drawn, in the input and in the positions that are written.
std::optional<std::array<SurfaceDistance, 2>> fit_of(const Run& run) {
  if (!(run.parameters().fit > 0.0)) return std::nullopt;
  const InputMesh& input = run.input();
  return std::array{surface_distance(input, input.mesh.positions), surface_distance(input, run.positions())};
}

int smooth(const SmoothOptions& options) {
  refuse_early(options);
  const Hints hints = parse_hints(options.run.hints);
  RunParameters parameters = parameters_of(options.run);
  const Acceleration acceleration = acceleration_for(parameters.backend);

  block_interrupts();  // before the session's threads start
  Session session(options.run.threads, acceleration, parameters.backend);
  session.set_history_budget(0);  // no past positions: none are asked for
  Checkpoints checkpoints(session, options.checkpoints);
  Progress progress;
  const Watch watch(progress, [&] {
    if (!checkpoints.end_soon()) progress.request_cancel();
  });
  const auto pool = session.pool();
  IoContext reading(progress, pool.get(), options.memory.bytes());
  options.reading.tell(reading);
  const auto input = load_input_on(options.input, options.surface, Need::Smoothing, reading, options.materials);
  std::vector<std::string> warnings = tell_findings(*input);
  fix_and_slide(parameters, *input, options.run.selections);
  require_fields(parameters.fields, input->mesh);
  parameters.kinds = tell_kinds(*input, parameters, options.run.selections, warnings);
  tell_interfaces(*input, parameters, warnings);
  const auto warn = [&warnings](std::string sentence) {
    complain(sentence);
    warnings.push_back(std::move(sentence));
  };
  if (!options.run.recipe.empty()) {
    const double gap = parameters.joint_gap;
    const auto said_gap = gap != RunParameters{}.joint_gap ? std::optional(gap) : std::nullopt;
    for (std::string& sentence : follow_recipe(recipe(options.run.recipe), *input, parameters, said_gap)) warn(std::move(sentence));
  }
  if (options.goal.until_converged) be_patient(parameters, options.goal.limits.patience);

  Run& run = begin_run(session, input, parameters, options.checkpoints, progress);
  if (std::string warning = run.take_warning(); !warning.empty()) warn(std::move(warning));
  if (run.size_field() && !run.size_field()->note().empty()) warn(run.size_field()->note());
  if (input->surface && !run.domain())
    warn(fmt::format("nothing slides on {}: --boundary slide lets the vertices of a volume's boundary", input->surface->mesh.name));
  const auto smooth_all = [&] {  // from the input on: without history no other positions are left after a failure
    const auto after = [&](const Run&) { checkpoints.after_iteration(); };
    const Outcome done = options.goal.until_converged ? run.until_converged_from_input(options.goal.limits, progress, after)
                                                      : run.iterate_from_input(options.goal.iterations, progress, after);
    run.sync_to_host();
    return done;
  };
  checkpoints.set_running(true);
  Outcome outcome = retry_on_cpu(run, smooth_all, warn);
  checkpoints.set_running(false);
  require_at_goal(run, outcome);
  const double seconds = smoothing_seconds(run);
  for (std::string& sentence : missing_phases(run)) warn(std::move(sentence));
  if (std::string other = seek_output_iteration(run, options.write, options.goal.until_converged, progress); !other.empty())
    warn(std::move(other));
  if (run.last_outcome()) outcome = *run.last_outcome();

  std::optional<LeftInverted> left = find_left_inverted(run);
  std::optional<Provenance> provenance;
  if (options.json || options.provenance) provenance = provenance_of(input->mesh, options.command_line);
  progress.begin("taking fields anew");
  MovedFields fields = move_fields(*input, run.parameters().fields, run.positions(), pool.get(), progress);
  const std::vector<Vec3> places = places_with_back(*input, run.positions(), pool.get(), progress);
  for (std::string& sentence : write_results(options, run, places, fields, provenance, {progress, pool.get()})) {
    complain(fmt::format("{}: {}", options.output.string(), sentence));
    warnings.push_back(std::move(sentence));
  }
  // The result is complete here; only reports follow.
  if (left) warn(left->sentence());
  const std::optional<CrossingFaces> crossing = find_crossing_faces(run);
  if (crossing) warn(crossing->sentence());
  std::optional<HeldMinimum> held;
  if (hints != Hints::Off) held = look_for_hints(run, left.has_value(), hints, seconds, pool, progress, warn);
  const SmoothReport result{.input = options.input,
                            .output = options.output,
                            .until_converged = options.goal.until_converged,
                            .run = run,
                            .vertices = input->mesh.vertex_count(),
                            .elements = input->mesh.elements.size(),
                            .free = run.visits_per_iteration(),
                            .fixed_by_user = run.parameters().fixed.size(),
                            .on_interfaces = input->interfaces.count(),
                            .threads = pool->size(),
                            .outcome = outcome,
                            .seconds = seconds,
                            .inside_alone_before = count_inverted(input->quality_context(), input->mesh.positions).inside_alone,
                            .left = std::move(left),
                            .crossing = crossing,
                            .fit = fit_of(run),
                            .card = report_card(run, pool.get()),
                            .held = std::move(held),
                            .fields = std::move(fields),
                            .warnings = std::move(warnings),
                            .provenance = std::move(provenance)};
  print_report(result, options.json);
  return all_well(result, options.strict) ? 0 : 1;
}

}  // namespace

void add_smooth(CLI::App& app, Action& action, const std::string& command_line) {
  auto options = std::make_shared<SmoothOptions>();
  options->command_line = command_line;
  CLI::App* subcommand = app.add_subcommand("smooth", "Smooth a mesh and write it");
  subcommand->add_option("IN", options->input, "Mesh to read")->required();
  subcommand->add_option("-o,--output", options->output, "Where to write it; the format is the extension's")->required()->type_name("OUT");
  add_run_options(*subcommand, options->run);
  add_surface_option(*subcommand, options->surface);
  add_materials_option(*subcommand, options->materials);
  add_goal_options(*subcommand, options->goal);
  subcommand
      ->add_option("--write", options->write,
                   "What is written: best (by inverted elements, then minimum, then mean; of an optimising method with --iterations the "
                   "last) or last")
      ->type_name("best|last")
      ->capture_default_str();
  subcommand->add_option("--stats", options->stats, "Write the statistics of every iteration; row 0 is the input")->type_name("FILE.csv");
  add_checkpoint_options(*subcommand, options->checkpoints);
  add_memory_option(*subcommand, options->memory);
  add_reading_options(*subcommand, options->reading);
  subcommand->add_flag(
      "--provenance", options->provenance,
      "Say in a comment of the mesh written what made it: the input's hash, version, options; where the format has comments");
  subcommand->add_flag("--strict", options->strict, "Exit with 1 where anything of the report card is worse than in the input, too");
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  const CLI::Option* iterations = subcommand->get_option("--iterations");
  subcommand->callback([options, iterations, &action] {
    // A recipe's later phases begin once the minimum has converged.
    if (!options->run.recipe.empty() && iterations->count() == 0) options->goal.until_converged = true;
    action = [options] { return within_memory(options->memory, options->input, [options] { return smooth(*options); }); };
  });
}

}  // namespace dmoscope::app
