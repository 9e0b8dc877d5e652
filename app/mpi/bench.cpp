// mpirun -n P dmoscope bench: measures how smoothing scales over ranks.

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/resource.h>

#include "app/common/console.h"
#include "app/common/option_checks.h"
#include "app/common/text.h"
#include "app/mpi/verbs.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/base/thread_pool.h"
#include "core/run/run.h"
#include "mpi/mesh/lattice.h"
#include "mpi/smooth/shared_mesh.h"

namespace dmoscope::app {
namespace {

struct SharedBenchOptions {
  std::uint64_t vertices = 200'000;
  std::string elements = "triangles", partition = "hilbert";
  std::uint64_t iterations = 4, repeats = 3;
  unsigned threads = 1;
  bool json = false;
};

/// The first ranks of a job; the others get no communicator.
class SomeRanks {
 public:
  SomeRanks(const World& world, int count) { MPI_Comm_split(world.comm(), world.rank() < count ? 0 : MPI_UNDEFINED, world.rank(), &comm_); }
  ~SomeRanks() {
    if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
  }
  SomeRanks(const SomeRanks&) = delete;
  SomeRanks& operator=(const SomeRanks&) = delete;
  [[nodiscard]] bool has_me() const noexcept { return comm_ != MPI_COMM_NULL; }
  [[nodiscard]] World world() const { return World(comm_); }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

/// Waits for all ranks without keeping a processor busy.
void wait_asleep(const World& world) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(world.comm(), &request);
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Costs with a number of ranks. Times are of one iteration, medians of the repeats; the slowest rank's.
struct Scaling {
  int ranks = 0;
  std::uint64_t vertices = 0, free = 0;
  double seconds = 0.0;        // from its start to its end, statistics included
  double visiting = 0.0;       // processor seconds of visits, the slowest rank's
  double visiting_mean = 0.0;  // processor seconds of visits, mean of the ranks
  double halo = 0.0;           // others' vertices, as a share of all vertices
  std::uint64_t bytes = 0;     // sent per iteration, the most of a rank
  std::uint64_t classes = 0, rounds = 0;
  double memory = 0.0;  // greatest peak of a rank so far, MB
  double setup = 0.0;   // time of partition, shares and colouring
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

Scaling measure(const World& world, std::uint64_t vertices, const SharedBenchOptions& options) {
  Scaling found{.ranks = world.size()};
  const Stopwatch setup;
  const SharedMesh mesh = share_block(world, lattice_block(world, vertices, options.elements == "tetrahedra"), "lattice",
                                      parse_partition(options.partition), SharedVertexWords({}), Need::Smoothing);
  const auto pool = std::make_shared<ThreadPool>(options.threads);
  RunParameters parameters;
  parameters.backend = Backend::Cpu;
  std::vector<double> seconds, visiting, visiting_mean;
  Progress progress;
  for (std::uint64_t repeat = 0; repeat < options.repeats; ++repeat) {
    Run run(mesh.input, parameters, pool, 0);
    if (repeat == 0) {
      found.setup = world.greatest(setup.seconds());
      found.free = world.sum(run.visits_per_iteration());
    }
    const double visited_before = mesh.share->cost().visiting;
    world.wait_for_all();
    const Stopwatch watch;
    run.iterate(options.iterations, progress);
    const auto each = static_cast<double>(options.iterations);
    const double mine = (mesh.share->cost().visiting - visited_before) / each;
    seconds.push_back(world.greatest(watch.seconds() / each));
    visiting.push_back(world.greatest(mine));
    visiting_mean.push_back(world.sum(mine) / world.size());
  }
  found.vertices = mesh.share->vertex_count();
  found.seconds = median(seconds);
  found.visiting = median(visiting);
  found.visiting_mean = median(visiting_mean);
  found.halo = static_cast<double>(world.sum(mesh.share->halo().size())) / static_cast<double>(found.vertices);
  found.bytes = world.greatest(mesh.share->bytes_sent());
  found.classes = mesh.share->classes();
  found.rounds = mesh.share->rounds();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  found.memory = world.greatest(static_cast<double>(usage.ru_maxrss) / 1024.0);
  return found;
}

Json json_of(const Scaling& one, const Scaling& alone) {
  return {{"ranks", one.ranks},
          {"vertices", one.vertices},
          {"free", one.free},
          {"seconds", one.seconds},
          {"seconds_of_one_rank", one.seconds / alone.seconds},
          {"processor_seconds", one.visiting},
          {"processor_seconds_of_one_rank", one.visiting / alone.visiting},
          {"imbalance", one.visiting / one.visiting_mean},
          {"halo", one.halo},
          {"bytes_sent", one.bytes},
          {"classes", one.classes},
          {"colouring_rounds", one.rounds},
          {"peak_memory_mb", one.memory},
          {"setup_seconds", one.setup}};
}

void print_scaling(std::string_view title, const std::vector<Scaling>& all) {
  print("{}\n{:>6} {:>12} {:>10} {:>8} {:>12} {:>8} {:>10} {:>8} {:>11} {:>9} {:>9}\n", title, "ranks", "vertices", "ms", "of one",
        "processor ms", "of one", "imbalance", "halo %", "bytes sent", "peak MB", "set-up s");
  for (const Scaling& one : all)
    print("{:>6} {:>12} {:>10.2f} {:>8.3f} {:>12.2f} {:>8.3f} {:>10.3f} {:>8.2f} {:>11} {:>9.0f} {:>9.2f}\n", one.ranks, one.vertices,
          1e3 * one.seconds, one.seconds / all.front().seconds, 1e3 * one.visiting, one.visiting / all.front().visiting,
          one.visiting / one.visiting_mean, 100.0 * one.halo, one.bytes, one.memory, one.setup);
}

int bench(const World& world, const SharedBenchOptions& options) {
  if (options.elements != "triangles" && options.elements != "tetrahedra")
    throw UsageError(fmt::format("--elements: '{}' is neither triangles nor tetrahedra", options.elements));
  std::vector<int> counts;
  for (int count = 1; count < world.size(); count *= 2) counts.push_back(count);
  counts.push_back(world.size());
  std::vector<Scaling> strong, weak;
  // Peak memory never falls: sizes with the least memory a rank, all of weak scaling, come first.
  const auto measure_all = [&](std::vector<Scaling>& into, bool shares_grow) {
    for (auto count = counts.rbegin(); count != counts.rend(); ++count) {
      const SomeRanks some(world, *count);
      const std::uint64_t part = options.vertices / static_cast<std::uint64_t>(world.size()) * static_cast<std::uint64_t>(*count);
      std::string failed;
      try {
        if (some.has_me()) into.push_back(measure(some.world(), shares_grow ? options.vertices : part, options));
      } catch (const SharedError& error) {  // waiting ranks do not know of it
        failed = error.what();
      }
      wait_asleep(world);
      world.together([&] {
        if (!failed.empty()) throw UsageError(failed);
      });
    }
  };
  measure_all(weak, false);
  measure_all(strong, true);
  if (!world.is_first()) return 0;
  std::ranges::reverse(strong);
  std::ranges::reverse(weak);
  if (options.json) {
    Json object{
        {"elements", options.elements}, {"iterations", options.iterations}, {"repeats", options.repeats}, {"threads", options.threads}};
    for (const auto& [name, list] : {std::pair("strong", &strong), std::pair("weak", &weak)}) {
      object[name] = Json::array();
      for (const Scaling& one : *list) object[name].push_back(json_of(one, list->front()));
    }
    print_json(object);
    return 0;
  }
  print(
      "{} by DMO, {} iterations, medians of {}; {} each. Seconds are those of ranks that share this machine's processors: beyond its\n"
      "number the processor time of the slowest rank tells what a rank of its own processor would take.\n\n",
      options.elements, options.iterations, options.repeats, counted(options.threads, "thread", "threads"));
  print_scaling("strong scaling: the same mesh", strong);
  print("\n");
  print_scaling("weak scaling: as much a rank", weak);
  return 0;
}

}  // namespace

void add_shared_bench(CLI::App& app, SharedAction& action) {
  auto options = std::make_shared<SharedBenchOptions>();
  CLI::App* subcommand = app.add_subcommand("bench", "Measure strong and weak scaling, with 1, 2, 4, ... ranks of this job in turn");
  subcommand->add_option("--vertices", options->vertices, "Of the lattice that is smoothed; with all ranks")
      ->transform(whole_number(9, 100'000'000'000))
      ->type_name("N")
      ->capture_default_str();
  subcommand->add_option("--elements", options->elements, "triangles or tetrahedra")->type_name("KIND")->capture_default_str();
  subcommand->add_option("--iterations", options->iterations, "Of each run")
      ->transform(whole_number(1, 1'000'000))
      ->type_name("N")
      ->capture_default_str();
  subcommand->add_option("--repeats", options->repeats, "Runs, of which the median counts")
      ->transform(whole_number(1, 1000))
      ->type_name("N")
      ->capture_default_str();
  subcommand->add_option("--threads", options->threads, "Threads of each rank")
      ->transform(whole_number(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  subcommand->add_option("--partition", options->partition, "Which rank has which vertices, see smooth")
      ->type_name("NAME")
      ->capture_default_str();
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  subcommand->callback([options, &action] { action = [options](const World& world) { return bench(world, *options); }; });
}

}  // namespace dmoscope::app
