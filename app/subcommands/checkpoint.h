#pragma once
// Checkpoints of long runs of `dmoscope smooth`, and runs that resume them.

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>

#include "core/session/session.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

struct CheckpointOptions {
  std::filesystem::path file;    // the checkpoint's file; empty: none
  std::filesystem::path resume;  // the file to resume; empty: the run begins at the input
  double every = 60.0;           // seconds
};

/// Declares --checkpoint, --checkpoint-every and --resume.
void add_checkpoint_options(CLI::App& subcommand, CheckpointOptions& options);

/// Checks the options as far as that needs no mesh. `others`: files that the subcommand reads or writes. Throws UsageError and OutputError.
void refuse_early(const CheckpointOptions& options, std::initializer_list<std::filesystem::path> others);

/// Begins the session's only run: a fresh one, or the saved one, which must have these parameters. Throws InputError for a damaged file,
/// UsageError for one of another mesh or with other parameters.
Run& begin_run(Session& session, const std::shared_ptr<const InputMesh>& input, const RunParameters& parameters,
               const CheckpointOptions& options, Progress& progress);

/// Saves a session at the end of an iteration: at regular times, and when the run is asked to end. If the disk is full a message says so,
/// and the run goes on.
class Checkpoints {
 public:
  Checkpoints(Session& session, const CheckpointOptions& options) : session_(session), options_(options) {}

  /// Asks for a checkpoint, on a signal, from any thread. Returns true if one follows, after which the run is cancelled.
  [[nodiscard]] bool end_soon() noexcept;
  /// Sets whether iterations are running, at whose ends the session can be saved.
  void set_running(bool running) noexcept { running_ = running && !options_.file.empty(); }
  /// To be called after every iteration. Throws Cancelled.
  void after_iteration();

 private:
  void save();

  using Clock = std::chrono::steady_clock;
  Session& session_;
  const CheckpointOptions& options_;
  Clock::time_point last_ = Clock::now();
  std::atomic<bool> running_{false}, ending_{false};
};

}  // namespace dmoscope::app
