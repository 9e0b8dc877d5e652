// mpirun -n N dmoscope smooth: the verb smooth by many processes.

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/output_checks.h"
#include "app/common/run_options.h"
#include "app/common/shared_options.h"
#include "app/common/smooth_report.h"
#include "app/common/text.h"
#include "app/mpi/verbs.h"
#include "core/base/error.h"
#include "core/base/thread_pool.h"
#include "core/io/mesh_io.h"
#include "core/io/writing/atomic_file.h"
#include "core/run/ending.h"
#include "core/run/recipe.h"
#include "core/smooth/execution/executor.h"
#include "core/smooth/execution/method_table.h"
#include "mpi/smooth/shared_mesh.h"

namespace dmoscope::app {
namespace {

struct SharedSmoothOptions {
  std::filesystem::path input, output, stats;
  RunOptions run;
  GoalOptions goal;
  std::string write = "best", partition = "hilbert";
  bool json = false;
};

void refuse(bool is_asked, std::string_view what) {
  if (is_asked) throw UsageError(fmt::format("several ranks do not do this: {}", what));
}

/// Throws UsageError for options that need more of the mesh than a rank has.
void refuse_what_needs_one_process(const RunOptions& options, const RunParameters& parameters) {
  refuse(method_info(parameters.method).joint || parameters.then_joint, "joint moves (--method joint, --then joint)");
  refuse(parameters.standing().slides() || !options.selections.slide.empty() || !options.selections.no_kinds(),
         "vertices that slide (--boundary slide, --slide, --interfaces slide, --corner, --feature)");
  refuse(parameters.combination && parameters.combination->size() != nullptr, "sizes (--combine with density)");
  refuse(parameters.order.seed.has_value(), "an order of visits but the natural one (--order)");
  refuse(parameters.backend == Backend::Cuda, "a device (--backend cuda)");
}

/// Makes the parameters. `without`: set to the parts of a recipe that are left out.
RunParameters shared_parameters(const SharedSmoothOptions& options, std::string& without) {
  RunParameters parameters = parameters_of(options.run);
  if (!options.run.recipe.empty()) {
    const Recipe& wanted = recipe(options.run.recipe);
    parameters.method = wanted.method;
    set_then(parameters, wanted.then, {});
    if (parameters.then_joint)
      without = fmt::format("the recipe \"{}\" goes without joint moves: several ranks do not do them", wanted.name);
    parameters.then_joint.reset();
  }
  refuse_what_needs_one_process(options.run, parameters);
  parameters.backend = Backend::Cpu;
  parameters.layers = LayerRule::Free;  // a rank need not have whole stacks of a boundary layer
  if (options.goal.until_converged) be_patient(parameters, options.goal.limits.patience);
  return parameters;
}

/// Reports progress of long runs, one line every few seconds, on rank 0.
class ProgressLines {
 public:
  explicit ProgressLines(bool tells) : tells_(tells) {}
  void after_iteration(const Run& run) {
    constexpr std::chrono::seconds kEvery{5};
    const auto now = std::chrono::steady_clock::now();
    if (!tells_ || now - last_ < kEvery) return;
    last_ = now;
    const IterationRecord& record = run.history().records().back();
    complain(fmt::format("iteration {}: minimum {}, mean {}, {} moved", record.iteration, brief(record.statistics.minimum),
                         brief(record.statistics.mean), record.moved));
  }

 private:
  bool tells_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Writes the results. Returns sentences about content that was not kept, on rank 0.
std::vector<std::string> write_results(const World& world, const SharedSmoothOptions& options, const Run& run, const SharedMesh& mesh,
                                       SharedMeshFile& file) {
  AtomicFiles others;
  world.together([&] {
    if (world.is_first() && !options.stats.empty()) others.add(options.stats, stats_of(run));
  });
  const std::vector<std::string> notes = file.write(options.output, positions_of_block(mesh, run.positions()));
  world.together([&] { others.commit(); });
  return world.gather_sentences(notes);
}

void refuse_early(const SharedSmoothOptions& options) {
  require_output_moment(options.write);
  require_same_kind(options.input, options.output);
  require_another_file(options.stats, "--stats", options.input);
  require_another_output(options.stats, "--stats", options.output);
  if (!same_mesh(options.output, options.input)) require_another_file(options.output, "--output", options.input);
}

int smooth(const World& world, const SharedSmoothOptions& options) {
  refuse_early(options);
  std::string without;
  RunParameters parameters = shared_parameters(options, without);
  const PartitionChoice partition = parse_partition(options.partition);
  const SharedVertexWords named(options.run.selections.fix.words);
  world.together([&] {
    if (!world.is_first()) return;
    require_writable(options.output);
    if (!options.stats.empty()) require_writable(options.stats);
  });
  const auto file = open_shared(world, options.input);
  const SharedMesh mesh = load_shared(world, *file, options.input, partition, named, Need::Smoothing);
  std::vector<std::string> warnings;
  const auto warn = [&](std::string sentence) {
    if (world.is_first()) complain(sentence);
    warnings.push_back(std::move(sentence));
  };
  if (!without.empty()) warn(without);
  for (const std::string& sentence : mesh.findings.sentences()) warn(fmt::format("{}: {}", mesh.input->mesh.name, sentence));
  if (mesh.findings.held > 0 && parameters.interfaces == InterfaceRule::Fixed)
    warn(fmt::format("{}: {} vertices on interfaces and lines stay (--interfaces free moves them)", mesh.input->mesh.name,
                     mesh.findings.held));
  const std::vector<std::string> nodal = file->nodal_fields();
  if (!nodal.empty() && (parameters.fields.all == FieldRule::Place || !parameters.fields.named.empty()))
    warn(fmt::format("{}: {} carried with the vertices: several ranks take no fields anew at new places, dmoscope alone does",
                     mesh.input->mesh.name, fmt::format("{} {}", fmt::join(nodal, ", "), nodal.size() == 1 ? "is" : "are")));
  parameters.fixed = mesh.named;
  world.together([&] {
    require_executable(Backend::Cpu, {},
                       {.method = parameters.method,
                        .input = mesh.input,
                        .metric = parameters.metric,
                        .search = parameters.search,
                        .options = parameters.options,
                        .combination = parameters.combination,
                        .then_mean = parameters.then_mean.has_value()});
  });

  const auto pool = std::make_shared<ThreadPool>(threads_of_rank(world, options.run.threads));
  Run run(mesh.input, parameters, pool, 0);
  Progress progress;
  ProgressLines lines(world.is_first());
  const auto after = [&](const Run& now) { lines.after_iteration(now); };
  Outcome outcome = options.goal.until_converged ? run.until_converged(options.goal.limits, progress, after)
                                                 : run.iterate(options.goal.iterations, progress, after);
  const double seconds = smoothing_seconds(run);
  for (std::string& sentence : missing_phases(run)) warn(std::move(sentence));
  if (std::string other = seek_output_iteration(run, options.write, options.goal.until_converged, progress); !other.empty())
    warn(std::move(other));
  if (run.last_outcome()) outcome = *run.last_outcome();
  run.rest();  // frees the smoother's memory for writing
  for (const std::string& sentence : write_results(world, options, run, mesh, *file))
    warn(fmt::format("{}: {}", options.output.string(), sentence));
  std::optional<LeftInverted> left = find_left_inverted(run);
  if (left) warn(left->sentence());

  const std::uint64_t inside_before = count_inverted(mesh.input->quality_context(), mesh.input->mesh.positions, *mesh.share).inside_alone;
  const std::uint64_t fixed_by_user = world.sum(std::uint64_t{mesh.named.size()});
  const SmoothReport report{.input = options.input,
                            .output = options.output,
                            .until_converged = options.goal.until_converged,
                            .run = run,
                            .vertices = mesh.share->vertex_count(),
                            .elements = mesh.share->element_count(),
                            .free = world.sum(run.visits_per_iteration()),
                            .fixed_by_user = fixed_by_user,
                            .on_interfaces = mesh.findings.held,
                            .threads = pool->size(),
                            .ranks = static_cast<unsigned>(world.size()),
                            .outcome = outcome,
                            .seconds = seconds,
                            .inside_alone_before = inside_before,
                            .left = std::move(left),
                            .fields = {.values = {}, .placed = {}, .whole = {}, .carried = nodal},
                            .warnings = std::move(warnings)};
  if (world.is_first()) print_report(report, options.json);
  return all_well(report, false) ? 0 : 1;
}

}  // namespace

void add_shared_smooth(CLI::App& app, SharedAction& action) {
  auto options = std::make_shared<SharedSmoothOptions>();
  CLI::App* subcommand = app.add_subcommand("smooth", "Smooth a mesh and write it");
  subcommand->add_option("IN", options->input, "Mesh to read: .vtu (raw appended data), .pvtu, .obj, .off, .14 or .grd")->required();
  subcommand->add_option("-o,--output", options->output, "Where to write it, in the format that was read")->required()->type_name("OUT");
  add_run_options(*subcommand, options->run);
  subcommand->get_option("--fix")->description(fmt::format("Vertices to keep where they are besides the boundary: {}", kSharedVertexWords));
  add_goal_options(*subcommand, options->goal);
  subcommand->add_option("--write", options->write, "What is written: best (of an optimising method with --iterations the last) or last")
      ->type_name("best|last")
      ->capture_default_str();
  subcommand
      ->add_option(
          "--partition", options->partition,
          "Which rank smooths which vertices: hilbert (pieces of a space-filling curve), block (as they lie in the file) or file:PATH "
          "(a number for each vertex). The result does not depend on it")
      ->type_name("NAME")
      ->capture_default_str();
  subcommand->add_option("--stats", options->stats, "Write the statistics of every iteration; row 0 is the input")->type_name("FILE.csv");
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  const CLI::Option* iterations = subcommand->get_option("--iterations");
  subcommand->callback([options, iterations, &action] {
    if (!options->run.recipe.empty() && iterations->count() == 0) options->goal.until_converged = true;
    action = [options](const World& world) { return smooth(world, *options); };
  });
}

}  // namespace dmoscope::app
