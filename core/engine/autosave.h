#pragma once
// Autosave of sessions, so that little is lost if the program ends unexpectedly.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/engine/safe_copy.h"
#include "core/session/session_standing.h"

namespace dmoscope {

struct AutosaveOptions {
  std::filesystem::path folder;             // folder in which this window gets a place of its own
  std::chrono::milliseconds every{20'000};  // interval of work
  double share = 0.05;                      // greatest share of a run's time for copies of positions that may be needed
};

/// Observes the session on the engine's thread, where it takes only references and, at times, a copy of positions; writes on a thread of
/// its own. States that are in files already are not saved again: see SavedMarks.
class Autosave {
 public:
  using Clock = std::chrono::steady_clock;
  /// Begins autosaving. `say`: called from any thread with messages for the user, such as on a full disk, each once. Throws OutputError.
  Autosave(AutosaveOptions options, std::function<void(const std::string&)> say);
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// Sets the JSON of the view, from any thread; see save_state.
  void set_view(std::string json);

  // --- On the engine's thread ---
  /// Names the autosaved files that the session was recovered from: they are removed once it has been autosaved again.
  void supersede(const std::vector<std::filesystem::path>& recovered);
  /// Saves if it is due, between two blocks of visits of `run`; also within an iteration, so that no more is lost of a long one. Throws
  /// DeviceError.
  void while_running(Session& session, const Run& run);
  /// Time of the next save; none: everything is safe.
  [[nodiscard]] std::optional<Clock::time_point> due(Session& session);
  /// Saves if it is due, or at once with `now`. Takes long only if positions must be recomputed, as long as `go_on` returns true.
  void at_rest(Session& session, bool now, const std::function<bool()>& go_on);

  /// Waits until pending files are written; false: not within `patience`.
  bool flush(std::chrono::milliseconds patience);
  /// Ends autosaving after a regular end of the program, and removes the file.
  void end();

 private:
  /// Identity of a session's state.
  struct Mark {
    std::weak_ptr<const InputMesh> input;
    std::vector<StandingRun> runs;
    [[nodiscard]] bool is(const Mark& other) const { return input.lock() == other.input.lock() && runs == other.runs; }
  };
  struct Job {
    SessionStanding session;
    std::string view;
    std::vector<std::filesystem::path> supersedes;
    bool remove = false;  // whether the file is not needed any more, and is removed
  };
  [[nodiscard]] static Mark mark_of(Session& session);
  void note_start(Session& session, const Run& run);
  void save(Session& session, const std::function<bool()>& go_on);
  void hand_over(Job job);
  void write(const std::stop_token& stop);
  void carry_out(Job& job);

  const AutosaveOptions options_;
  const std::function<void(const std::string&)> say_;
  const SafePlace place_;
  Clock::time_point next_;
  Mark known_;  // the last state that was examined
  IterationStarts starts_;
  Clock::time_point next_start_{};  // earliest time for the next copy into starts_
  bool kept_ = false;               // whether a file exists, or will soon

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string view_;
  std::vector<std::filesystem::path> superseded_;
  std::optional<Job> job_;  // the newest job, which replaces older ones
  bool writing_ = false, ended_ = false;
  std::atomic<bool> failed_{false};  // whether writing the newest job failed
  std::string said_;
  std::jthread thread_;  // last member, so that all others exist before it starts
};

}  // namespace dmoscope
