#include "app/subcommands/checkpoint.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/output_checks.h"
#include "core/session/state_file.h"

namespace dmoscope::app {

void add_checkpoint_options(CLI::App& subcommand, CheckpointOptions& options) {
  constexpr double kLongest = 1e9;
  auto* file = subcommand.add_option("--checkpoint", options.file,
                                     "Save the run there every now and then, and at a signal that ends it, to go on with --resume");
  file->type_name("FILE");
  subcommand.add_option("--checkpoint-every", options.every, "Seconds between two checkpoints; 0: one after every iteration")
      ->check(CLI::Range(0.0, kLongest).description(""))
      ->needs(file)
      ->type_name("SECONDS")
      ->capture_default_str();
  subcommand
      .add_option("--resume", options.resume,
                  "Go on with what --checkpoint saved, by the same options; the result is the same, bit for bit, as without the break")
      ->type_name("FILE");
}

void refuse_early(const CheckpointOptions& options, std::initializer_list<std::filesystem::path> others) {
  if (options.file.empty()) return;
  for (const std::filesystem::path& other : others) require_another_output(options.file, "--checkpoint", other);
  require_writable(options.file);
}

namespace {

void refuse_another_run(const Run& run, RunParameters wanted, const std::filesystem::path& file) {
  wanted.search.simd = run.parameters().search.simd;  // all instructions give the same bits
  if (wanted.then_joint && run.parameters().then_joint) wanted.then_joint->from_best = run.parameters().then_joint->from_best;
  if (wanted.then_mean && run.parameters().then_mean) wanted.then_mean->from_best = run.parameters().then_mean->from_best;  // not an option
  if (run.parameters() == wanted) return;
  RunParameters but_fixed = wanted;
  but_fixed.fixed = run.parameters().fixed;
  if (run.parameters() == but_fixed)
    throw UsageError(
        fmt::format("--resume {}: --fix names other vertices ({}) than when this run was begun ({}): its words, or the groups "
                    "and data of the mesh that they name, have changed",
                    file.string(), wanted.fixed.size(), run.parameters().fixed.size()));
  throw UsageError(fmt::format("--resume {}: give the options that this run was begun with ({})", file.string(), run.title()));
}

}  // namespace

Run& begin_run(Session& session, const std::shared_ptr<const InputMesh>& input, const RunParameters& parameters,
               const CheckpointOptions& options, Progress& progress) {
  if (options.resume.empty()) {
    session.replace({session.make_run(input, parameters)}, 0, parameters.metric);
    return session.active();
  }
  if (const std::string note = open_state(options.resume, session, progress, input); !note.empty())
    complain(fmt::format("{}: {}", options.resume.string(), note));
  if (session.run_count() != 1)
    throw UsageError(fmt::format("--resume {}: a session of several runs is no checkpoint", options.resume.string()));
  refuse_another_run(session.active(), parameters, options.resume);
  const Run& run = session.active();
  if (!run.edits().all().empty() || !run.moment().is_iteration_end() || run.history().records().size() != run.moment().iteration + 1)
    throw UsageError(fmt::format("--resume {}: it was stepped by hand, which is no checkpoint", options.resume.string()));
  return session.active();
}

bool Checkpoints::end_soon() noexcept {
  if (!running_) return false;
  ending_ = true;
  return true;
}

void Checkpoints::after_iteration() {
  if (!running_) return;
  const bool due = std::chrono::duration<double>(Clock::now() - last_).count() >= options_.every;
  if (!due && !ending_) return;
  try {
    save();
  } catch (const OutputError& error) {
    complain(fmt::format("no checkpoint: {}", error.what()));
  }
  if (!ending_) return;
  throw Cancelled();
}

void Checkpoints::save() {
  Progress unwatched;
  last_ = Clock::now();  // also after a failure, so that the next try is not immediate
  save_state(options_.file, session_, {}, unwatched);
  if (ending_)
    complain(fmt::format("{}: saved at iteration {}; --resume goes on from there", options_.file.string(),
                         session_.active().moment().iteration));
}

}  // namespace dmoscope::app
