#pragma once
// A session on a thread of its own. Window, script or test post command lines and read views; no other code touches the session, so long
// operations never block the window.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/progress.h"
#include "core/commands/session_commands.h"
#include "core/engine/autosave.h"
#include "core/engine/command_end.h"
#include "core/view/frame_builder.h"
#include "core/view/view.h"

namespace dmoscope {

/// Pause after a publication that took `cost`, before the next one: so long that publishing takes at most a sixth of the worker's time, at
/// 60 light frames a second or 10 whole ones at most.
[[nodiscard]] std::chrono::steady_clock::duration publication_pause(bool light, std::chrono::steady_clock::duration cost);

class Engine {
 public:
  /// Starts the engine with an empty session, see Session.
  explicit Engine(unsigned threads = 0, Acceleration acceleration = {}, Backend backend = Backend::Auto);
  /// Cancels the command at work, drops the waiting ones, and joins the thread.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Queues one command line of the table in commands.h. Returns at once the command's number (1, 2, ...); errors become Messages. A
  /// command that changes only what is shown (CommandReach::Look) passes those that only change paths, also the one at work: it is carried
  /// out, and a view with its result published, after the present block of visits. Statistics and the like for another metric follow with
  /// the next view (Frame::provisional).
  std::uint64_t post(std::string command_line);
  /// Number of commands posted and not yet finished, with the one at work.
  [[nodiscard]] std::size_t pending() const;
  [[nodiscard]] bool busy() const { return pending() != 0; }
  /// Sets the states that views show besides the active run from now on: see SessionView::watched. Returns at once; a new view follows.
  void watch(std::vector<Watch> watched);
  /// Blocks until nothing is pending and all work at rest is done (for scripts and tests; the window never calls it).
  void wait_idle();
  /// Cancels the command at work and drops the waiting ones, except those that would have passed them (see post).
  void cancel();
  [[nodiscard]] const Progress& progress() const noexcept { return progress_; }
  /// The command at work, as typed; empty when idle.
  [[nodiscard]] std::string current_command() const;

  /// Lets computing threads give way to the program's other threads, from the next command that smooths on, see give_way(ThreadPool&): for
  /// a window.
  void give_way() { give_way_ = true; }
  /// Turns off long work at rest, such as the search for the hold of a minimum: views show its results only if a command asked for them.
  void rest_without_long_work() { long_work_ = false; }

  /// Sets the function behind `save-report`, which runs on the engine's thread: core writes no pages. To be called before the first post.
  using ReportWriter = std::function<void(Session&, const std::filesystem::path&, Progress&)>;
  void set_report_writer(ReportWriter writer);

  /// Turns on autosave; see Autosave. To be called before the first post. Throws OutputError.
  void autosave(AutosaveOptions options);
  /// Sets the view's JSON that is autosaved: see save_state. Without effect before autosave().
  void set_autosaved_view(std::string json);
  [[nodiscard]] bool autosaves() const noexcept { return autosave_ != nullptr; }
  /// Autosaves at once, as soon as no command is at work, and waits for that; false: not within `patience`.
  bool autosave_now(std::chrono::milliseconds patience);
  /// Ends autosaving after a regular end, and removes the autosaved file.
  void end_autosave();

  /// The latest state; never null. During a command new frames are published (light ones of a run on a device, see Frame), each
  /// publication_pause() after the one before and only once that was taken by view(); at its end a whole one.
  [[nodiscard]] std::shared_ptr<const SessionView> view();
  /// Messages since the last call, oldest first.
  [[nodiscard]] std::vector<Message> take_messages();
  /// Ends of the commands that finished since the last call, in their order.
  [[nodiscard]] std::vector<CommandEnd> take_ends();
  /// Sets the function that the worker calls for every new view or message (the window wakes its event loop with it). To be called before
  /// the first post.
  void set_wake(std::function<void()> wake);

 private:
  void work(const std::stop_token& stop);
  void work_off(std::unique_lock<std::mutex>& lock);
  struct Posted {
    std::uint64_t id = 0;
    std::string line;
  };
  [[nodiscard]] CommandEnd run_one(const Posted& command);
  [[nodiscard]] CommandEnd::Kind execute(const std::string& line);
  void safeguard();
  [[nodiscard]] std::deque<Posted>::iterator next_look();
  void carry_out_looks();
  void publish(FrameDetail detail);
  void publish_if_due();
  void publish_at_rest();
  void rest(const std::stop_token& stop);
  [[nodiscard]] bool try_at_rest(const std::function<bool()>& go_on);
  [[nodiscard]] bool wait_for_work(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void autosave_at_rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop, bool now);
  [[nodiscard]] std::vector<Watch> watched() const;
  void say(Message message);

  Progress progress_;
  Session session_;  // used by the worker alone
  CommandContext context_;
  CommandTable commands_;
  std::function<void()> wake_;

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Posted> queue_;
  Posted current_;
  std::uint64_t last_id_ = 0;
  std::vector<CommandEnd> ends_;
  std::vector<Watch> watched_;
  bool watch_new_ = false;  // no view has these watches yet
  bool working_ = false;
  bool safe_wanted_ = false;  // whether autosave_now() waits
  bool looks_pass_ = false;   // whether the command at work only changes paths
  bool resting_ = false;      // whether the worker does work at rest
  int waiting_ = 0;           // number of callers in wait_idle()
  std::vector<Message> messages_;
  std::shared_ptr<const SessionView> view_;
  std::atomic<bool> taken_{true};
  std::atomic<bool> give_way_{false}, long_work_{true};
  FrameBuilder frames_;
  std::chrono::steady_clock::time_point next_publication_;
  std::unique_ptr<Autosave> autosave_;  // null: autosave is off
  std::jthread thread_;                 // last member, so that all others exist before it starts
};

}  // namespace dmoscope
