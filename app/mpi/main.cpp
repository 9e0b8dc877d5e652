// dmoscope-mpi: the verbs that many processes do together. dmoscope starts it if mpirun started dmoscope.

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/mpi/verbs.h"
#include "core/base/error.h"

namespace dmoscope::app {

unsigned threads_of_rank(const World& world, unsigned wanted) {
  if (wanted != 0) return wanted;
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(world.comm(), MPI_COMM_TYPE_SHARED, world.rank(), MPI_INFO_NULL, &here);
  const auto ranks = static_cast<unsigned>(World(here).size());
  MPI_Comm_free(&here);
  return std::max(1U, std::thread::hardware_concurrency() / ranks);
}

namespace {

constexpr int kWrongUsage = 2, kBadInputOrOutput = 3;

/// Runs the action. The first rank reports an error that all ranks throw; an error of one rank ends all of them, for they wait for it.
int guarded(const World& world, const SharedAction& action) {
  const auto alone = [&](const std::string& what, int code) {
    complain(world.size() == 1 ? what : fmt::format("rank {}: {}", world.rank(), what));
    MpiSession::abort(code);
  };
  try {
    return action(world);
  } catch (const SharedError& error) {
    if (world.is_first()) complain(error.what());
    return error.exit_code();
  } catch (const UsageError& error) {  // in words that all ranks have
    if (world.is_first()) complain(error.what());
    return error.exit_code();
  } catch (const Error& error) {
    alone(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    alone("not enough memory for this mesh", kBadInputOrOutput);
  } catch (const std::exception& error) {
    alone(fmt::format("unexpected error (please report it): {}", error.what()), kBadInputOrOutput);
  }
  return kBadInputOrOutput;
}

/// Throws UsageError if srun started several processes that this MPI does not connect, so that each of them is alone.
void refuse_lonely_tasks(const World& world) {
  const char* const tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  if (world.size() > 1 || tasks == nullptr || std::string_view(tasks) == "1") return;
  const char* const task = std::getenv("SLURM_PROCID");
  if (task != nullptr && std::string_view(task) != "0") std::exit(kWrongUsage);
  throw UsageError(fmt::format("srun started {} processes that do not know of each other: try srun --mpi=pmix, or mpirun", tasks));
}

int run(const World& world, int argc, char** argv) {
  refuse_lonely_tasks(world);
  CLI::App app("Smooth and judge meshes with many processes: mpirun -n N dmoscope smooth IN -o OUT.", "dmoscope");
  app.set_version_flag("--version", std::string("dmoscope ") + DMOSCOPE_VERSION);
  app.require_subcommand(1);
  SharedAction action;
  add_shared_smooth(app, action);
  add_shared_quality(app, action);
  add_shared_bench(app, action);
  app.footer(
      "The result has the same bytes for any number of processes. What is not here one process does alone. Exit codes: 0 done; 1 ran but "
      "did "
      "not reach what was asked; 2 wrong usage; 3 bad input or output.");
  const auto is_called = [&](const CLI::App* subcommand) { return subcommand->get_name() == argv[1]; };
  const auto known = app.get_subcommands({});
  if (argc > 1 && argv[1][0] != '-' && std::none_of(known.begin(), known.end(), is_called)) {
    if (world.is_first())
      complain(fmt::format("{}: several processes smooth, judge (quality) and measure (bench) alone; start one for this", argv[1]));
    return kWrongUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (!world.is_first()) return error.get_exit_code() == 0 ? 0 : kWrongUsage;
    if (error.get_exit_code() == 0) {
      std::ostringstream text;
      app.exit(error, text, text);
      print_lines(text.str());
      return 0;
    }
    complain(error.what(), "Run with --help for more information.");
    return kWrongUsage;
  }
  return guarded(world, action);
}

}  // namespace
}  // namespace dmoscope::app

int main(int argc, char** argv) {
  dmoscope::app::ignore_file_limit_signal();
  const dmoscope::MpiSession session(argc, argv);
  const dmoscope::World world;
  try {
    const int code = dmoscope::app::run(world, argc, argv);
    if (code != 3 && world.is_first()) dmoscope::app::flush_output();
    return code;
  } catch (const dmoscope::UsageError& error) {
    dmoscope::app::complain(error.what());
    dmoscope::MpiSession::abort(error.exit_code());
  } catch (const std::exception& error) {
    dmoscope::app::complain(error.what());
    dmoscope::MpiSession::abort(3);
  }
}
