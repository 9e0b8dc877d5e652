#pragma once
// Saves a session by itself, so that little is lost when the program ends as nobody wished.

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
  std::filesystem::path folder;             // one place there is this window's
  std::chrono::milliseconds every{20'000};  // of work
  double share = 0.05;                      // of a run's time, at most, for copies of positions in case they are needed
};

/// Looks at the session on the engine's thread, where it takes no more than references and, at times, a copy of positions; writes on a
/// thread of its own. What is in files already is not saved again: see SavedMarks.
class Autosave {
 public:
  using Clock = std::chrono::steady_clock;
  /// `say`: called from any thread with what a person should know, such as a full disk, once. Throws OutputError.
  Autosave(AutosaveOptions options, std::function<void(const std::string&)> say);
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// Of whoever shows the session, from any thread; see save_state.
  void set_view(std::string json);

  // On the engine's thread:
  /// The session came of these files: once it was saved by itself again, those that a window had saved by itself are removed.
  void supersede(const std::vector<std::filesystem::path>& recovered);
  /// Between two blocks of visits of `run`: saves where it is time, in the midst of an iteration too, so that no more is lost of one that
  /// takes long. Throws DeviceError.
  void while_running(Session& session, const Run& run);
  /// When there is to be saved next; none: what there is is safe.
  [[nodiscard]] std::optional<Clock::time_point> due(Session& session);
  /// Saves where it is time, or at once where `now`. Takes long only where positions must be computed again, as long as `go_on` says.
  void at_rest(Session& session, bool now, const std::function<bool()>& go_on);

  /// Waits until what was to be written is; false: not within `patience`.
  bool flush(std::chrono::milliseconds patience);
  /// A good end: nothing is saved from now on, and what was is removed.
  void end();

 private:
  /// Which state of a session it is.
  struct Mark {
    std::weak_ptr<const InputMesh> input;
    std::vector<StandingRun> runs;
    [[nodiscard]] bool is(const Mark& other) const { return input.lock() == other.input.lock() && runs == other.runs; }
  };
  struct Job {
    SessionStanding session;
    std::string view;
    std::vector<std::filesystem::path> supersedes;
    bool remove = false;  // there is nothing to be kept any more
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
  Mark known_;  // the state that was looked at last
  IterationStarts starts_;
  Clock::time_point next_start_{};  // when the next of these may be noted
  bool kept_ = false;               // there is, or will be, a file of it

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string view_;
  std::vector<std::filesystem::path> superseded_;
  std::optional<Job> job_;  // the newest; what waits longer is of no use
  bool writing_ = false, ended_ = false;
  std::atomic<bool> failed_{false};  // to write the newest
  std::string said_;
  std::jthread thread_;  // last: everything above exists before it starts
};

}  // namespace dmoscope
